#pragma once

#include "math/vec.h"

#include <cstdint>

namespace peregrine::scene {

struct Texture;

// What rays see that leave the scene. The values are those of RT_SKY_*.
enum class SkyKind : uint32_t {
    none = 0, // Environment::background
    gradient = 1,
    texture = 2,
};

struct Sky {
    SkyKind kind = SkyKind::none;
    math::Vec3 zenith{0}; // these three of a gradient
    math::Vec3 horizon{0};
    math::Vec3 ground{0};
    const Texture* texture = nullptr; // kept alive by the snapshot
    float intensity = 1;
    float cosine = 1; // of the angle by which it is turned about +Y
    float sine = 0;
};

} // namespace peregrine::scene
