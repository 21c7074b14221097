#pragma once

#include "math/vec.h"
#include "shade/kernels.h"
#include "shade/surface.h"

#include <cstdint>

namespace peregrine::render {

// What debug views show instead of radiance, as display values; black where nothing was hit.

// 0.5 n + 0.5 of the shading normal.
void show_normals(const shade::RayHits& hits, const shade::Surface& surface,
                  float* const colors[3]);

// Near is white, `range` is black.
void show_depth(const shade::RayHits& hits, const float* t, float range, float* const colors[3]);

// Nodes visited as a heat map: blue, green, yellow, red, and white from `range` on. Rays that miss
// count too.
void show_steps(const uint32_t* steps, uint32_t count, float range, float* const colors[3]);

math::Vec3 heat(float fraction);

} // namespace peregrine::render
