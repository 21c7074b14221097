#pragma once

#include "render/plan.h"

#include <cstdint>

namespace peregrine::render {

struct TileBuffers;

namespace post {

// How bright the pixels of a picture are, by 64ths of octaves. Counts have no order, so what they
// say does not depend on who counted which tile.
class LuminanceCounts {
public:
    void add(float luminance);
    void add(const LuminanceCounts& other);

    // The geometric mean, as eyes compare light by ratios (Reinhard et al. 2002, equation 1),
    // within a hundredth; 0 if nothing was counted. What is darker than a thousandth counts for
    // that, so that a few black pixels do not rule it.
    float mean() const;

private:
    static constexpr uint32_t kOctaves = 40, kInOctave = 64;

    uint32_t counts_[kOctaves * kInOctave]; // of zeroed memory
};

// A stage: counts the radiance of the tile's pixels.
void count_luminance(const Plan& plan, TileBuffers& buffers);

} // namespace post
} // namespace peregrine::render
