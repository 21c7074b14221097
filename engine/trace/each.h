#pragma once

#include "trace/kernels.h"

namespace peregrine::trace {

// Streams one ray at a time: for machines without SIMD kernels, and what the others are compared
// with.

template <Hit (*Closest)(const Target&, const math::Ray&, const Filter&)>
void closest_each(const Target& target, const RayStream& rays, const Filter& filter,
                  const HitStream& hits) {
    for (uint32_t i = 0; i < rays.count; ++i)
        hits.store(i, Closest(target, ray_at(rays, i), filter));
}

template <bool (*Occluded)(const Target&, const math::Ray&, const Filter&)>
void occluded_each(const Target& target, const RayStream& rays, const Filter& filter,
                   uint8_t* result) {
    for (uint32_t i = 0; i < rays.count; ++i) result[i] = Occluded(target, ray_at(rays, i), filter);
}

} // namespace peregrine::trace
