#pragma once

#include "accel/bih/split.h"

#include <span>

namespace peregrine::accel::bih {

// Neighbours on the curve whose common bounds are at hand.
inline constexpr uint32_t kBlock = 16;
inline size_t blocks_for(size_t references) {
    return (references + kBlock - 1) / kBlock;
}

// One reference a triangle into room for as many, in ascending order along the curve through their
// centres; each one's weight is its place there. Their blocks' bounds into room for those. Returns
// what they span.
Bounds make_sorted_references(std::span<const geometry::Triangle> triangles,
                              base::Scheduler& scheduler, base::Memory* memory,
                              Reference* references, Bounds* blocks);

// As split(), of references in that order, at the first bit in which they differ: the spatial
// median of Lauterbach et al. (Eurographics 2009). Nothing moves.
bool split_sorted(const Task& task, const Range& range, Halves& halves);

} // namespace peregrine::accel::bih
