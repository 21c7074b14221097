#pragma once

#include "base/memory.h"
#include "math/box.h"

#include <cstdint>

namespace peregrine::accel::instances {

// Every level of inner nodes halves its instances; the traversal stacks are sized from it.
inline constexpr uint32_t kMaxDepth = 20;
inline constexpr uint32_t kMaxInstances = 1u << kMaxDepth;

// What an instance fills of the world. Rays are asked for in its own space, rounded to float there:
// the box holds what they may hit once it is widened by margin + slope * |origin|_inf.
struct Extent {
    math::Box box;
    float margin = 0;
    float slope = 0;

    void extend(const Extent& other);
};

// An inner node's left child is the next node.
struct Node {
    Extent extent;
    uint32_t right;    // of an inner node, else 0: a leaf
    uint32_t instance; // of a leaf
};
static_assert(sizeof(Node) == 40);

} // namespace peregrine::accel::instances
