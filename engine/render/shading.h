#pragma once

#include "render/plan.h"
#include "render/tile_buffers.h"

namespace peregrine::render {

// Stages from hits to radiance: every ray for itself, ...
void shade_tile(const Plan& plan, TileBuffers& buffers);

// ... or light in blocks (shade/blocks).
void shade_blocks(const Plan& plan, TileBuffers& buffers);

} // namespace peregrine::render
