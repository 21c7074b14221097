#pragma once

#include "accel/bvh/reference.h"

#include <algorithm>
#include <limits>
#include <span>

namespace peregrine::accel::bvh {

// Box of references and of their doubled centres.
struct Extent {
    Bounds bounds;
    Bounds centers;

    void extend(const Reference& reference) {
        bounds.extend(reference.bounds());
        centers.extend(reference.doubled_center());
    }
};

Extent extent_of(std::span<const Reference> references);

// A plane between the bins of centres. Costs count blocks: half areas, relative to the node's box,
// times blocks.
struct Split {
    float cost = std::numeric_limits<float>::infinity();
    uint32_t axis = 0;
    uint32_t bin = 0;   // the first on the right
    Floats common = {}; // size of what the children's boxes have in common

    bool found() const { return cost < std::numeric_limits<float>::infinity(); }
};

// So that no area overflows, nor vanishes.
inline float scale_of(const Bounds& bounds) {
    const Floats size = bounds.upper - bounds.lower;
    const float largest = std::max(std::max(size[0], size[1]), size[2]);
    return largest > 0 ? std::min(1 / largest, std::numeric_limits<float>::max()) : 0;
}

// What the heuristic counts for a child. Begun blocks alone would have it fill blocks at any price,
// while leaves can still be joined later.
inline float blocks_of(uint32_t count) {
    return 0.75f * float((count + 3) / 4) + 0.0625f * float(count);
}

// Which bin a centre is in, on each axis.
class BinMapping {
public:
    BinMapping(const Bounds& centers, uint32_t bins) : origin_(centers.lower) {
        for (int axis = 0; axis < 3; ++axis) {
            const float size = centers.upper[axis] - centers.lower[axis];
            scale_[axis] =
                size > 0 ? std::min(float(bins) / size, std::numeric_limits<float>::max()) : 0;
            last_[axis] = float(bins - 1);
        }
    }
    Ints operator()(const Floats& doubled_center) const {
        return __builtin_convertvector(min((doubled_center - origin_) * scale_, last_), Ints);
    }

private:
    Floats origin_;
    Floats scale_ = {};
    Floats last_ = {};
};

inline constexpr uint32_t kMaxBins = 64;

Split find_split(std::span<const Reference> references, const Extent& extent, uint32_t bins);

} // namespace peregrine::accel::bvh
