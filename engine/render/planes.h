#pragma once

#include "render/plan.h"
#include "render/tile_buffers.h"

namespace peregrine::render {

// A stage: the planes beside the pixels that the frame asks for.
void write_planes(const Plan& plan, TileBuffers& buffers);

} // namespace peregrine::render
