#pragma once

#include "math/vec.h"
#include "render/plan.h"
#include "render/tile_buffers.h"

namespace peregrine::render {

// Stages of debug views: what they show instead of radiance, as display values; black where nothing
// was hit.

// 0.5 n + 0.5 of the shading normal.
void show_normals(const Plan& plan, TileBuffers& buffers);

// Near is white, frame.depth_range is black.
void show_depth(const Plan& plan, TileBuffers& buffers);

// Nodes visited as a heat map: blue, green, yellow, red, and white from frame.steps_range on. Rays
// that miss count too.
void show_steps(const Plan& plan, TileBuffers& buffers);

// How light was found: red by shadow rays, green without any, blue interpolated.
void show_light(const Plan& plan, TileBuffers& buffers);

math::Vec3 heat(float fraction);

} // namespace peregrine::render
