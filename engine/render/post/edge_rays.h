#pragma once

#include "render/plan.h"
#include "render/tile_buffers.h"

#include <cstdint>

namespace peregrine::render::post {

inline constexpr uint32_t kMostEdgeSamples = 16;

// Where the rays through a pixel at an edge go, in pixels from its centre, beside the one through
// the centre: the same in each pixel and frame.
struct EdgePattern {
    explicit EdgePattern(uint32_t samples);

    uint32_t count; // without the centre
    float x[kMostEdgeSamples - 1];
    float y[kMostEdgeSamples - 1];
};

// Traces the tile's pixels with edges from a key on, and puts their means in the frame's image, or
// on the film of a frame that will be enlarged.
void trace_tile_edges(const Plan& plan, const EdgePattern& pattern, uint32_t least_key,
                      TileBuffers& buffers);

} // namespace peregrine::render::post
