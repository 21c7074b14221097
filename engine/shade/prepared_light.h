#pragma once

#include "math/box.h"
#include "scene/light.h"
#include "shade/falloff.h"

#include <algorithm>

namespace peregrine::shade {

// A light as the kernels want it: single precision, constants folded.
struct PreparedLight {
    scene::LightType type;
    bool casts_shadow;
    bool from_light; // its shadow rays start at the light, where they share their origin
    math::Vec3 position;
    math::Vec3 direction;
    math::Vec3 color; // multiplies the weights: all constants of the fall-off are in here
    float radius;
    float inverse_radius;
    float cone_outer_cos;
    float cone_scale; // 1 / (inner - outer)
};

// Shadow rays run from the light if it is within the bounds of the scene: the lift of surfaces
// covers the errors of rays from there (see SurfaceSpace). Positions are relative to `origin`.
inline PreparedLight prepare(const scene::Light& light, const math::Box& bounds,
                             const math::Vec3d& origin) {
    const bool finite = light.type != scene::LightType::directional;
    const float gain = finite ? kFalloffGain / (light.radius * light.radius) : 1.0f;
    const float cone = std::max(light.cone_inner_cos - light.cone_outer_cos, 1e-5f);
    const math::Vec3 position(light.position);
    const bool inside = finite && glm::clamp(position, bounds.lower, bounds.upper) == position;
    return {light.type,
            light.casts_shadow,
            inside,
            math::Vec3(light.position - origin),
            light.direction,
            light.intensity * gain,
            light.radius,
            1.0f / light.radius,
            light.cone_outer_cos,
            1.0f / cone};
}

// Whether any point of the box may be lit. The margin covers the rounding of both sides.
inline bool reaches(const PreparedLight& light, const math::Box& box) {
    if (light.type == scene::LightType::directional) return true;
    const math::Vec3 nearest = glm::min(glm::max(light.position, box.lower), box.upper);
    const math::Vec3 offset = light.position - nearest;
    return glm::dot(offset, offset) <= light.radius * light.radius * 1.0001f;
}

} // namespace peregrine::shade
