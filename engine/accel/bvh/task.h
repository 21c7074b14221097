#pragma once

#include "accel/bvh/builder.h"
#include "accel/bvh/reference.h"
#include "accel/kdtree/control.h"

#include <cstdint>

namespace peregrine::accel::bvh {

using kdtree::Control;

inline constexpr uint64_t kMaxTriangles = uint64_t(1) << 27;

// Three levels of binary nodes can always become one of wide nodes.
inline constexpr uint32_t kMaxBinaryDepth = 3 * kMaxDepth;

// Binary leaves hold at most one block; the collapse joins them where that is cheaper.
inline constexpr uint32_t kBinaryLeaf = kBlockWidth;

// How hard a build tries.
struct Effort {
    uint32_t bins;
    uint32_t spatial_bins; // 0: no spatial splits
    double duplicates;     // at most, as a part of the triangles
    float overlap;         // of the root's area, from which spatial splits are tried
};

// What all parts of one build share.
struct Task {
    const geometry::Triangle* triangles;
    BuildOptions options;
    Effort effort;
    Control& control;
    base::Memory* memory;
    float root_scale = 0;
    float root_area = 0; // scaled

    bool overlaps(const Floats& common) const {
        return half_area(common * root_scale) > effort.overlap * root_area;
    }
};

} // namespace peregrine::accel::bvh
