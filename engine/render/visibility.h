#pragma once

#include "render/frame.h"
#include "render/tile.h"

namespace peregrine::render {

// What the primary rays of a tile hit, ray by ray.
struct TileHits {
    const float* t;
    const float* u;
    const float* v;
    const uint32_t* triangle;
};

// Writes the planes of visibility that the frame asks for.
void write_planes(const scene::Snapshot& snapshot, const Frame& frame, const Tile& tile,
                  const TileHits& hits);

} // namespace peregrine::render
