#pragma once

#include "accel/bin_mapping.h"
#include "accel/reference.h"

#include <limits>
#include <span>

namespace peregrine::accel::bvh {

// A plane between the bins of centres. Costs count blocks: half areas, relative to the node's box,
// times blocks.
struct Split {
    float cost = std::numeric_limits<float>::infinity();
    uint32_t axis = 0;
    uint32_t bin = 0;   // the first on the right
    Floats common = {}; // size of what the children's boxes have in common

    bool found() const { return cost < std::numeric_limits<float>::infinity(); }
};

// The cost of a child. If it were the number of begun blocks, splits would fill blocks at any
// price, although leaves can still be joined later.
inline float blocks_of(uint32_t count) {
    return 0.75f * float((count + 3) / 4) + 0.0625f * float(count);
}

inline constexpr uint32_t kMaxBins = 64;

Split find_split(std::span<const Reference> references, const Extent& extent, uint32_t bins);

} // namespace peregrine::accel::bvh
