#pragma once

#include "base/memory.h"
#include "math/box.h"

#include <cstdint>

namespace peregrine::accel::bvh {

inline constexpr uint32_t kWidth = 8;      // children of a node
inline constexpr uint32_t kBlockWidth = 4; // triangles of a block
inline constexpr uint32_t kMaxLeaf = 32;   // triangles of a leaf

// Levels of nodes, enforced by the builder; the traversal stacks are sized from it: a node on the
// way down leaves at most kWidth - 1 children behind.
inline constexpr uint32_t kMaxDepth = 24;
inline constexpr uint32_t kStackSize = kMaxDepth * (kWidth - 1) + 1;

// A child: another node, or a leaf with 1 to kMaxLeaf triangles that fill blocks from `first` on.
struct Link {
    static constexpr uint32_t kLeaf = 0x80000000u;

    uint32_t bits;

    static Link inner(uint32_t node) { return {node}; }
    static Link leaf(uint32_t first_block, uint32_t count) {
        return {kLeaf | first_block << 5 | (count - 1)};
    }

    bool is_leaf() const { return (bits & kLeaf) != 0; }
    uint32_t node() const { return bits; }
    uint32_t first_block() const { return (bits & ~kLeaf) >> 5; }
    uint32_t count() const { return (bits & 31) + 1; }
};
static_assert(sizeof(Link) == 4);

// Places without a child have the empty box, +infinity to -infinity, which no ray enters.
struct alignas(64) Node {
    float lower[3][kWidth];
    float upper[3][kWidth];
    Link child[kWidth];
    // For each octant of directions (bit k: direction k is negative) the places from front to back,
    // three bits each, the first in the lowest.
    uint32_t order[8];
};
static_assert(sizeof(Node) == 256);

// Four triangles, vertex by vertex and axis by axis. What a leaf's last block has beyond its count
// repeats the last triangle.
struct alignas(16) Block {
    float vertex[3][3][kBlockWidth];
    uint32_t triangle[kBlockWidth]; // index in the list that was built from
};
static_assert(sizeof(Block) == 160);

struct BuildReport {
    double sah_cost = 0; // expected cost of a ray through the bounds, in tests of blocks
    double build_ms = 0;
    uint32_t max_depth = 0; // levels of nodes
    uint64_t leaves = 0;
    uint64_t references = 0;   // triangles in leaves; more than there are where splits cut them
    uint64_t largest_leaf = 0; // triangles
};

// Node 0 is the root. A leaf's box holds the part of its triangles that it stands for: every point
// of a triangle lies in the box of a leaf that has it, and in all boxes above.
struct Tree {
    explicit Tree(base::Memory* memory) : nodes(memory), blocks(memory) {}

    base::Vector<Node> nodes; // empty if there are no triangles
    base::Vector<Block> blocks;
    math::Box bounds; // of all triangles
    BuildReport report;
};

} // namespace peregrine::accel::bvh
