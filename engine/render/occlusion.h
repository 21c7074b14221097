#pragma once

#include "render/plan.h"
#include "render/tile_buffers.h"

namespace peregrine::render {

// A stage: how much of the ambient light reaches what the tile's rays hit, in blocks if the frame
// wants that (shade/occlusion). Fills buffers.openness.
void find_openness(const Plan& plan, TileBuffers& buffers);

// A stage in the place of shading: what the stage before found, and where.
void show_openness(const Plan& plan, TileBuffers& buffers);

} // namespace peregrine::render
