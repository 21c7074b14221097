#pragma once

#include "shade/material/program.h"
#include "shade/surface/surface.h"

#include <algorithm>
#include <cstdint>

namespace peregrine::shade {

// What comes from all around.
enum class Surroundings : uint32_t {
    even = 0,   // the ambient light
    hidden = 1, // as much of it as Illumination::openness says
    bright = 2, // that, and Illumination::bounced
};
inline constexpr uint32_t kSurroundings = 3;

// Light that arrived at a batch.
struct alignas(64) Illumination {
    Surface::Lanes irradiance[3];
    Surface::Lanes highlight[3]; // irradiance times the lobe; with Program::highlight
    Surface::Lanes openness;     // how much of the ambient light arrives; by Surroundings
    Surface::Lanes bounced[3];   // what other surfaces send, as ambient light; by Surroundings

    void clear(Program program) {
        const uint32_t lanes = program == Program::matt ? 3 : 6;
        std::fill_n(&irradiance[0][0], lanes * kPadded, 0.0f);
    }
};

// What one light gives to a batch, in parts of its colour.
struct alignas(64) LightWeights {
    Surface::Lanes diffuse; // fall-off times cosine
    Surface::Lanes lobe;    // times this: the highlight
};

} // namespace peregrine::shade
