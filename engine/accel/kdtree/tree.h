#pragma once

#include "base/memory.h"
#include "math/box.h"

#include <cstdint>

namespace peregrine::accel::kdtree {

// Enforced by the builder; the traversal stacks are sized from it.
inline constexpr uint32_t kMaxDepth = 64;

// 8 bytes. An inner node has a split plane and two children side by side; a leaf has a range of
// references. The lower 2 bits of `link` are the axis, or 3 for a leaf.
struct Node {
    static constexpr uint32_t kLeaf = 3;

    union {
        float split;
        uint32_t first_reference;
    };
    uint32_t link;

    static Node inner(uint32_t axis, float split, uint32_t left_child) {
        Node node;
        node.split = split;
        node.link = left_child << 2 | axis;
        return node;
    }

    static Node leaf(uint32_t first_reference, uint32_t count) {
        Node node;
        node.first_reference = first_reference;
        node.link = count << 2 | kLeaf;
        return node;
    }

    uint32_t axis() const { return link & 3; }
    bool is_leaf() const { return axis() == kLeaf; }
    uint32_t left_child() const { return link >> 2; } // right child = left + 1
    uint32_t reference_count() const { return link >> 2; }
};
static_assert(sizeof(Node) == 8, "eight nodes to a cache line");

struct BuildReport {
    double sah_cost = 0; // expected cost of a ray through the bounds, in triangle tests
    double build_ms = 0;
    uint32_t max_depth = 0;
    uint32_t depth_limit = 0;
    uint64_t leaves = 0;
    uint64_t empty_leaves = 0;
    uint64_t largest_leaf = 0; // references
};

// Node 0 is the root. Every triangle is referenced by each leaf that holds a point of it, or, where
// that point lies on a split plane, by a leaf on at least one side: what trace/ relies on.
struct Tree {
    explicit Tree(base::Memory* memory) : nodes(memory), references(memory) {}

    base::Vector<Node> nodes;
    base::Vector<uint32_t> references; // indices of triangles
    math::Box bounds;                  // of all triangles
    BuildReport report;
};

} // namespace peregrine::accel::kdtree
