#pragma once

#include "accel/bvh/reference.h"
#include "base/memory.h"

#include <cstdint>

namespace peregrine::accel::bvh {

// What is built first and made wide later. An inner node's children come after it.
struct BinaryNode {
    static constexpr uint32_t kLeaf = 0x80000000u;

    float lower[3];
    uint32_t first; // left child, or first reference
    float upper[3];
    uint32_t second; // right child, or number of references with kLeaf

    bool is_leaf() const { return (second & kLeaf) != 0; }
    uint32_t count() const { return second & ~kLeaf; }

    void set_bounds(const Bounds& bounds) {
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis] = bounds.lower[axis];
            upper[axis] = bounds.upper[axis];
        }
    }
    math::Box box() const {
        return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}};
    }
};
static_assert(sizeof(BinaryNode) == 32);

} // namespace peregrine::accel::bvh
