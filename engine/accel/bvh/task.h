#pragma once

#include "accel/bvh/builder.h"
#include "accel/kdtree/control.h"

#include <cstdint>

namespace peregrine::accel::bvh {

using kdtree::Control;

inline constexpr uint64_t kMaxTriangles = uint64_t(1) << 27;

// Three levels of binary nodes can always become one of wide nodes.
inline constexpr uint32_t kMaxBinaryDepth = 3 * kMaxDepth;

// Binary leaves hold at most one block; the collapse joins them where that is cheaper.
inline constexpr uint32_t kBinaryLeaf = kBlockWidth;

// What all parts of one build share.
struct Task {
    const geometry::Triangle* triangles;
    BuildOptions options;
    uint32_t bins;
    Control& control;
    base::Memory* memory;
};

} // namespace peregrine::accel::bvh
