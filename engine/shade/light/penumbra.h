#pragma once

#include "shade/light/shadows.h"

namespace peregrine::shade {

// As Shadows::hide_occluded, of a light that is a sphere: points lose the part of its light that is
// hidden from them. All of them ask for its centre, and one of each four neighbours in the batch
// for its rim; where that is not all or nothing, light.shadow_samples points of it decide. Returns
// how many points see nothing. What light there is without shadows is that of the centre. Uses
// memory.fixed_*, since nothing is remembered of spheres.
uint32_t hide_penumbra(const Shadows& shadows, const PreparedLight& light, uint32_t ray_count,
                       ShadowMemory& memory, LightWeights& weights);

// After that: the rays toward the light's centre, for who wants to trace them once more.
void list_centers_again(uint32_t ray_count, ShadowMemory& memory);

} // namespace peregrine::shade
