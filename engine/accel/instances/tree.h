#pragma once

#include "base/memory.h"
#include "math/box.h"

#include <cstdint>

namespace peregrine::accel::instances {

inline constexpr uint32_t kWidth = 8; // children of a node

// Every level of nodes has an eighth of the instances of the one above; the traversal stacks are
// sized from it.
inline constexpr uint32_t kMaxDepth = 7;
inline constexpr uint32_t kStackSize = kMaxDepth * (kWidth - 1) + 1;
inline constexpr uint32_t kMaxInstances = 1u << 20;

// What an instance fills of the world. Rays are asked for in its own space, rounded to float there:
// the box holds what they may hit once it is widened by margin + slope * |origin|_inf.
struct Extent {
    math::Box box;
    float margin = 0;
    float slope = 0;

    void extend(const Extent& other);
};

// Another node, or an instance.
struct Link {
    static constexpr uint32_t kLeaf = 0x80000000u;

    uint32_t bits;

    bool is_leaf() const { return (bits & kLeaf) != 0; }
    uint32_t node() const { return bits; }
    uint32_t instance() const { return bits & ~kLeaf; }
};

// Children lie in places 0 to count - 1.
struct alignas(64) Node {
    float lower[3][kWidth];
    float upper[3][kWidth];
    float margin[kWidth];
    float slope[kWidth];
    Link child[kWidth];
    uint32_t count;

    Extent extent(uint32_t i) const {
        return {{{lower[0][i], lower[1][i], lower[2][i]}, {upper[0][i], upper[1][i], upper[2][i]}},
                margin[i],
                slope[i]};
    }
};
static_assert(sizeof(Node) == 320);

} // namespace peregrine::accel::instances
