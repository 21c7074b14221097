#pragma once

#include "render/plan.h"
#include "render/tile_buffers.h"

namespace peregrine::render {

// Stages from hits to radiance: every ray for itself, ...
void shade_tile(const Plan& plan, TileBuffers& buffers);

// ... or light in blocks.
void shade_blocks(const Plan& plan, TileBuffers& buffers);

// Fills buffers.light, in blocks if the frame wants that (shade/blocks).
void find_light(const Plan& plan, TileBuffers& buffers);

} // namespace peregrine::render
