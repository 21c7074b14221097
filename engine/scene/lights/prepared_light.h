#pragma once

#include "geometry/lift.h"
#include "math/box.h"
#include "scene/light.h"
#include "scene/lights/falloff.h"
#include "trace/visibility/point_visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peregrine::scene {

// A light as the kernels want it: single precision, constants folded.
struct PreparedLight {
    LightType type;
    Falloff falloff;
    bool casts_shadow;
    bool from_light; // its shadow rays start at the light, where they share their origin
    math::Vec3 position;
    math::Vec3 direction;
    math::Vec3 color; // multiplies the weights: all constants of the fall-off are in here
    float radius;
    float inverse_radius;
    float inverse_nearest; // of inverse squares: nearer places are lit as from 1 / this
    float cone_outer_cos;
    float cone_scale; // 1 / (inner - outer)
    float source_radius;
    uint32_t shadow_samples;
    float fog_scatter;
    const trace::visibility::PointVisibility* visibility =
        nullptr; // what is remembered; null: nothing
};

// The cheapest fall-off with the light's values.
inline Falloff cheapest_falloff(const Light& light) {
    using enum Falloff;
    const bool no_window = light.falloff == windowed_inverse_square && std::isinf(light.radius);
    return no_window ? inverse_square : light.falloff;
}

// What the weights of the kernels are to be multiplied by.
inline float falloff_gain(const Light& light) {
    const auto of = [&](const PaperFalloff& falloff) {
        return std::min(falloff.gain / (light.radius * light.radius),
                        std::numeric_limits<float>::max()); // of the tiniest radii
    };
    if (light.type == LightType::directional) return 1;
    switch (light.falloff) {
    case Falloff::schlick_linear:
        return of(kSchlickLinear);
    case Falloff::linear:
        return of(kLinear);
    case Falloff::cosine_linear:
        return of(kCosineLinear);
    default:
        return 1;
    }
}

constexpr bool is_inverse_square(Falloff falloff) {
    return falloff == Falloff::windowed_inverse_square || falloff == Falloff::inverse_square;
}

// Farther than 1e12 m the kernels of Arauna's fall-offs would overflow, which cube distances.
inline float end_of(const Light& light) {
    return is_inverse_square(light.falloff) ? light.radius : std::min(light.radius, 1e12f);
}

// 1 / d^2 is cut where it would make the light exceed kBrightest.
inline float inverse_nearest(const math::Vec3& intensity) {
    const float strongest = std::max({intensity.x, intensity.y, intensity.z, 1e-10f});
    return std::sqrt(kBrightest / strongest);
}

// Shadow rays run from the light if no point of the scene is farther from any of it, along an axis,
// than the scene's largest side: then they are no longer than those of a light within its bounds,
// whose errors the lift of surfaces covers (shade/surface/space.h).
inline bool is_near(const Light& light, const math::Box& bounds) {
    if (light.type == LightType::directional) return false;
    const math::Vec3 position(light.position);
    const math::Vec3 most = glm::max(position - bounds.lower, bounds.upper - position);
    return std::max({most.x, most.y, most.z}) + light.source_radius
           <= geometry::largest_side(bounds);
}

inline PreparedLight prepare(const Light& light, const math::Box& bounds) {
    const math::Vec3 color = glm::min(light.intensity * falloff_gain(light),
                                      math::Vec3(std::numeric_limits<float>::max()));
    const float cone = std::max(light.cone_inner_cos - light.cone_outer_cos, 1e-5f);
    return {light.type,
            cheapest_falloff(light),
            light.casts_shadow,
            is_near(light, bounds),
            math::Vec3(light.position),
            light.direction,
            color,
            end_of(light),
            1.0f / light.radius,
            inverse_nearest(light.intensity),
            light.cone_outer_cos,
            1.0f / cone,
            light.source_radius,
            light.shadow_samples,
            light.fog_scatter};
}

// Whether any point of the box may be lit. The margin covers the rounding of both sides.
inline bool reaches(const PreparedLight& light, const math::Box& box) {
    if (light.type == LightType::directional) return true;
    const math::Vec3 nearest = glm::min(glm::max(light.position, box.lower), box.upper);
    const math::Vec3 offset = light.position - nearest;
    return glm::dot(offset, offset) <= light.radius * light.radius * 1.0001f;
}

} // namespace peregrine::scene
