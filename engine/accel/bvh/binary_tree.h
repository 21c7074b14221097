#pragma once

#include "accel/reference.h"
#include "base/memory.h"

#include <cstdint>

namespace peregrine::accel::bvh {

// What is built first and made wide later.
struct BinaryNode {
    static constexpr uint32_t kLeaf = 0x80000000u;

    float lower[3];
    uint32_t first; // left child, or first reference in the arena
    float upper[3];
    uint32_t second; // right child, or number of references with kLeaf

    bool is_leaf() const { return (second & kLeaf) != 0; }
    uint32_t count() const { return second & ~kLeaf; }

    void set(const Bounds& bounds, uint32_t one, uint32_t other) {
        store4(with_last_lane(bounds.lower, one), lower);
        store4(with_last_lane(bounds.upper, other), upper);
    }
    void set_bounds(const Bounds& bounds) {
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis] = bounds.lower[axis];
            upper[axis] = bounds.upper[axis];
        }
    }
    Bounds bounds() const {
        return {with_last_lane(load4(lower), 0), with_last_lane(load4(upper), 0)};
    }
};
static_assert(sizeof(BinaryNode) == 32);

// Node 0 is the root, and children come after their parents. The nodes up to the first part's begin
// are its top; a part's nodes have all their children in the same part, so that threads can work on
// parts without each other.
struct BinaryTree {
    struct Part {
        uint32_t begin;
        uint32_t end;
    };

    explicit BinaryTree(base::Memory* memory) : nodes(memory), parts(memory) {}

    uint32_t top() const { return parts.empty() ? uint32_t(nodes.size()) : parts[0].begin; }

    base::Vector<BinaryNode> nodes;
    base::Vector<Part> parts;
};

} // namespace peregrine::accel::bvh
