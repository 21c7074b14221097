#pragma once

#include "scene/fog.h"
#include "scene/light.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace peregrine::test {

using Sees = std::function<bool(const math::Vec3d& place)>;

inline double fog_density_at(const scene::Fog& fog, double height) {
    if (height <= fog.bottom) return double(fog.density);
    if (height >= fog.top) return 0;
    return double(fog.density) * (fog.top - height) / (fog.top - fog.bottom);
}

// What a surface that faces the lamp gets of each candela, as rt.h has it.
inline double lux_at(const scene::Light& light, const math::Vec3d& place) {
    const math::Vec3d way = place - light.position;
    const double d = glm::length(way), R = double(light.radius), x = d / R;
    if (x >= 1) return 0;
    double share = 1;
    if (light.type == scene::LightType::spot) {
        const double outer = double(light.cone_outer_cos);
        const double rim = std::max(double(light.cone_inner_cos) - outer, 1e-5);
        const double s =
            (glm::dot(way, math::Vec3d(glm::normalize(light.direction))) / d - outer) / rim;
        if (s <= 0) return 0;
        share = s >= 1 ? 1 : s * s * (3 - 2 * s);
    }
    const double lobe = std::cos(std::acos(-1.0) * x / 2);
    switch (light.falloff) {
    case scene::Falloff::schlick_linear:
        return share * 93.01 * (1 - x) * (1 - x) / (1 + 4.47 * x) / (R * R);
    case scene::Falloff::linear:
        return share * 27.386 * (1 - x) / (R * R);
    case scene::Falloff::cosine_linear:
        return share * 42.054 * lobe * lobe * (1 - x) / (R * R);
    case scene::Falloff::windowed_inverse_square:
        return share * (1 - x * x * x * x) / (d * d);
    default:
        return share / (d * d);
    }
}

// Radiance of each candela that fog scatters into a ray, by the midpoint rule.
inline double airlight_along(
    const scene::Fog& fog, const scene::Light& light, const math::Vec3d& from,
    const math::Vec3d& unit, double metres,
    const Sees& sees = [](const math::Vec3d&) { return true; }) {
    constexpr int kSteps = 12000;
    const double nearest = glm::dot(light.position - from, unit);
    const double end = std::min(metres, nearest + double(light.radius));
    if (end <= 0) return 0;
    const double step = end / kSteps;
    double depth = 0, sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const math::Vec3d place = from + unit * (step * (i + 0.5));
        const double density = fog_density_at(fog, place.y);
        const double lux = density > 0 ? lux_at(light, place) : 0;
        if (lux > 0 && sees(place)) sum += density * lux * std::exp(-depth - 0.5 * density * step);
        depth += density * step;
    }
    return sum * step * double(light.fog_scatter) / (4 * std::acos(-1.0));
}

} // namespace peregrine::test
