#pragma once

#include "scene/light_passing.h"
#include "shade/surface/surface.h"

#include <cstdint>

namespace peregrine::shade {

// One thread's working memory for the light of one lamp that a batch gets through glass.
struct alignas(64) TintMemory {
    math::Box boxes[scene::kMostLightPassing]; // of what light may pass on the way
    uint32_t box_count;
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
