#pragma once

#include "render/plan.h"
#include "render/tile_buffers.h"

namespace peregrine::render {

// What is the same for all tiles of a frame.
void begin_primary_rays(const Plan& plan, TileBuffers& buffers);

// What the first `count` of buffers.direction hit. Alike neighbours are faster.
void trace_rays_from_eye(const Plan& plan, TileBuffers& buffers, uint32_t count,
                         const trace::ImageTile* image);

// A stage: one ray through each pixel of the tile, and what it hits.
void trace_primary_rays(const Plan& plan, TileBuffers& buffers);

} // namespace peregrine::render
