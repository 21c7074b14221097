#pragma once

#include "render/plan.h"
#include "render/tile_buffers.h"

namespace peregrine::render {

// Stages from hits to radiance: every ray for itself, ...
void shade_tile(const Plan& plan, TileBuffers& buffers);

// ... or light in blocks.
void shade_blocks(const Plan& plan, TileBuffers& buffers);

// A stage: the sky, where the rays of the tile hit nothing. Paths paint it themselves.
void paint_sky(const Plan& plan, TileBuffers& buffers);
// ... the fog before what they hit.
void hide_in_fog(const Plan& plan, TileBuffers& buffers);
void hide_in_fog(const Plan& plan, TileBuffers& buffers, uint32_t ray_count);

// buffers.light takes what the scratch has of a batch, or gives it.
void keep_light(const shade::RayHits& hits, uint32_t first, TileBuffers& buffers);
void take_light(const Plan& plan, const shade::RayHits& hits, uint32_t first, TileBuffers& buffers);

// Fills buffers.light, in blocks if the frame wants that (shade/blocks).
void find_light(const Plan& plan, TileBuffers& buffers);

} // namespace peregrine::render
