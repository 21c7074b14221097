#pragma once

#include "render/plan.h"
#include "render/tile_buffers.h"

namespace peregrine::render {

// A stage: asks for the memory of these planes, so that it comes while rays are traced. To write to
// what is not in a cache takes longer than to find what is written.
void fetch_planes(const Plan& plan, TileBuffers& buffers);

// A stage: the planes beside the pixels that the frame asks for.
void write_planes(const Plan& plan, TileBuffers& buffers);

} // namespace peregrine::render
