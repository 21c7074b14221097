#pragma once

#include "shade/surface/surface.h"

#include <cstdint>

namespace peregrine::shade {

// One thread's working memory for the shadow rays of a batch toward one light.
struct alignas(64) ShadowMemory {
    using Lanes = Surface::Lanes;

    Lanes origin[3];
    Lanes direction[3];
    uint32_t index[kPadded]; // of rays: their point in the batch
    Lanes moved_origin[3];   // relative to the world's origin, if the others are not
    // Where rays begin and end, 0 and 1 being the surface and the light or the reverse.
    Lanes zeros;
    Lanes just_above_zero;
    Lanes just_below_one;
    Lanes ones;
    Lanes infinities;
    // Of what is remembered of the light, and of rays that only fixed triangles are asked about.
    alignas(64) uint32_t states[kPadded]; // trace::visibility::State
    Lanes fixed_origin[3];
    Lanes fixed_direction[3];
    uint32_t fixed_index[kPadded];
    uint8_t fixed_occluded[kPadded];
    static constexpr uint8_t kFree = 0, kOccluded = 1, kPenumbra = 2;
    uint8_t occluded[kPadded]; // kPenumbra of spheres alone
    uint64_t ray_count;

    void initialize(); // of zeroed memory
};

} // namespace peregrine::shade
