#pragma once

#include "math/vec.h"
#include "scene/sky.h"

#include <cstdint>

namespace peregrine::scene {

enum class LightType : uint32_t { point = 0, spot = 1, directional = 2 };

// Of points and spots, see scene/lights/falloff.h. The values are those of RT_FALLOFF_*.
enum class Falloff : uint32_t {
    schlick_linear = 0,
    linear = 1,
    cosine_linear = 2,
    windowed_inverse_square = 3,
    inverse_square = 4,
};
inline constexpr uint32_t kFalloffCount = 5;

struct Light {
    LightType type = LightType::point;
    math::Vec3d position{0};
    math::Vec3 direction{0, -1, 0}; // the way the light travels, unit length
    float radius = 10;              // no light beyond; infinite: no end
    Falloff falloff = Falloff::windowed_inverse_square;
    math::Vec3 intensity{1}; // candela, or lux if directional
    float cone_inner_cos = 1;
    float cone_outer_cos = 0.70710678f;
    bool casts_shadow = true;
    // Of the sphere that shines, in metres, or, of directional lights, of the disc at a metre. Its
    // shadows have penumbras, of so many samples a place.
    float source_radius = 0;
    uint32_t shadow_samples = 16;
    float fog_scatter = 0; // the part of fog's extinction that scatters its light, 0 to 1

    bool operator==(const Light&) const = default;
};

struct Environment {
    math::Vec3 ambient{0.1f};
    math::Vec3 background{0};
    Sky sky{};
};

} // namespace peregrine::scene
