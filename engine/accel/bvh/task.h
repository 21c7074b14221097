#pragma once

#include "accel/bvh/builder.h"
#include "accel/control.h"
#include "accel/reference.h"

#include <cstdint>

namespace peregrine::accel::bvh {

inline constexpr uint64_t kMaxTriangles = uint64_t(1) << 27;

// Three levels of binary nodes can always become one of wide nodes.
inline constexpr uint32_t kMaxBinaryDepth = 3 * kMaxDepth;

// How hard a build tries.
struct Effort {
    uint32_t bins;         // of small nodes; larger ones have more
    uint32_t spatial_bins; // 0: no spatial splits
    uint32_t subtree;      // references, at least, that one thread goes on with
    uint32_t treelet;      // references; so few have every plane tried
    uint32_t binary_leaf;  // references; the collapse joins leaves where that is cheaper
    uint32_t reinsertions; // rounds
    double reinserted;     // part of the nodes in a round
    double duplicates;     // room for them, as a part of the triangles
    double bytes;          // wanted, per triangle
};

// What all parts of one build share.
struct Task {
    const geometry::Triangle* triangles;
    Effort effort;
    Control& control;
    base::Memory* memory;
    uint32_t depth_limit = kMaxBinaryDepth;
    float root_scale = 0;
    float least_overlap = 0; // half area, scaled, from which on spatial splits are tried
};

} // namespace peregrine::accel::bvh
