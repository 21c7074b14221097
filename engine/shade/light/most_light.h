#pragma once

#include "scene/lights/prepared_light.h"

namespace peregrine::shade {

// At least as many lux as a light gives to any surface in the box, of its strongest colour: as if
// the surface nearest to it faced it, in the middle of a spot. All fall-offs only fall.
inline float most_light(const scene::PreparedLight& light, const math::Box& box) {
    const float strongest = std::max({light.color.x, light.color.y, light.color.z}) * 1.001f;
    if (light.type == scene::LightType::directional) return strongest;
    const math::Vec3 nearest = glm::min(glm::max(light.position, box.lower), box.upper);
    const math::Vec3 offset = light.position - nearest;
    const float distance = std::sqrt(glm::dot(offset, offset));
    const float x = distance * light.inverse_radius, rest = std::max(1.0f - x, 0.0f);
    const float inverse = std::min(1.0f / distance, light.inverse_nearest);
    const float square = strongest * inverse * inverse;
    switch (light.falloff) {
    case scene::Falloff::schlick_linear:
        return strongest * rest * rest / (1.0f + scene::kSchlickBend * x);
    case scene::Falloff::cosine_linear: {
        const float cosine = std::cos(1.5707963f * std::min(x, 1.0f));
        return strongest * rest * cosine * cosine;
    }
    case scene::Falloff::linear:
        return strongest * rest;
    case scene::Falloff::windowed_inverse_square:
        return square * std::max(1.0f - x * x * x * x, 0.0f);
    default:
        return square;
    }
}

} // namespace peregrine::shade
