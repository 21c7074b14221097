#pragma once

#include "base/memory.h"
#include "math/box.h"

#include <cstdint>

namespace peregrine::accel::bih {

// Levels of inner nodes, enforced by the builder; the traversal stacks are sized from it.
inline constexpr uint32_t kMaxDepth = 64;

// Three kinds, told apart by the lower 3 bits of `link`:
//   inner  two children side by side; on the node's axis the left one ends at clip[0] and the right
//          one begins at clip[1]. These may overlap, or leave a gap that belongs to neither.
//   cut    one child, which on the axis lies between clip[0] and clip[1].
//   leaf   a range of references.
struct Node {
    static constexpr uint32_t kLeaf = 3;
    static constexpr uint32_t kCut = 4;

    union {
        float clip[2];
        uint32_t range[2];
    };
    uint32_t link;

    static Node inner(uint32_t axis, float left_end, float right_begin, uint32_t left_child) {
        return with_clips(left_end, right_begin, left_child << 3 | axis);
    }
    static Node cut(uint32_t axis, float begin, float end, uint32_t child) {
        return with_clips(begin, end, child << 3 | kCut | axis);
    }
    static Node leaf(uint32_t first_reference, uint32_t count) {
        Node node;
        node.range[0] = first_reference;
        node.range[1] = count;
        node.link = kLeaf;
        return node;
    }

    bool is_leaf() const { return (link & kLeaf) == kLeaf; }
    bool is_cut() const { return (link & kCut) != 0; }
    uint32_t axis() const { return link & 3; }
    uint32_t child() const { return link >> 3; } // or the left one; the right one is the next
    void move_child(uint32_t by) { link += by << 3; }
    uint32_t first_reference() const { return range[0]; }
    uint32_t reference_count() const { return range[1]; }

private:
    static Node with_clips(float first, float second, uint32_t link) {
        Node node;
        node.clip[0] = first;
        node.clip[1] = second;
        node.link = link;
        return node;
    }
};
static_assert(sizeof(Node) == 12 && alignof(Node) == 4);

struct BuildReport {
    double sah_cost = 0; // expected cost of a ray through the bounds, in triangle tests
    double build_ms = 0;
    uint32_t max_depth = 0; // levels of inner nodes
    uint64_t leaves = 0;
    uint64_t largest_leaf = 0; // references
};

// Node 0 is the root. Every triangle is in one leaf, and on the way there lies, whole, within the
// planes of the children taken: what trace/ relies on.
struct Tree {
    explicit Tree(base::Memory* memory) : nodes(memory), references(memory) {}

    base::Vector<Node> nodes;          // empty if there are no triangles
    base::Vector<uint32_t> references; // indices of triangles, each once
    math::Box bounds;                  // of all triangles
    BuildReport report;
};

} // namespace peregrine::accel::bih
