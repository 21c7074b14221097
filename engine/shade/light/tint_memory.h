#pragma once

#include "shade/surface/surface.h"

#include <cstdint>

namespace peregrine::shade {

// One thread's working memory for the light of one lamp that a batch gets through glass.
struct alignas(64) TintMemory {
    // Rays that nothing opaque hides, of which some meet anything.
    Surface::Lanes origin[3];
    Surface::Lanes direction[3];
    uint32_t ray[kPadded]; // of ShadowMemory's list
    uint8_t meets[kPadded];
    // What is tinted.
    uint32_t point[kPadded]; // of the batch
    float weight[kPadded];   // of LightWeights::diffuse
    math::Vec3 tint[kPadded];
    uint32_t count;
};

} // namespace peregrine::shade
