#pragma once

#include "render/plan.h"
#include "render/tile_buffers.h"

namespace peregrine::render {

// A stage: from hits to radiance.
void shade_tile(const Plan& plan, TileBuffers& buffers);

} // namespace peregrine::render
