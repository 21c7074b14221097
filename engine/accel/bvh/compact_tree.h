#pragma once

#include "accel/bvh/tree.h"

#include <cstddef>

// The wide BVH in fewer bytes, for what it costs to decode. Boxes are bytes in a frame of their
// node's own (Ylitie, Karras, Laine 2017); the leaves of a node share their vertices, which keep
// all their bits (cf. Benthin, Wald, Woop, Afra 2018).
namespace peregrine::accel::bvh {

// Along axis k, plane q lies at origin[k] + q * scale[k]. The lower eight bits of the scale are 0,
// which makes the product exact: there is one rounding, with or without a fused multiply-add, and
// every machine decodes the same plane. Planes are chosen so that what is decoded contains the box.
struct alignas(64) CompactNode {
    float origin[3];
    float scale[3]; // normal numbers
    // As in Node, but of a leaf it is kLeaf and the unit where its record begins.
    Link child[kWidth];
    uint8_t lower[3][kWidth];
    uint8_t upper[3][kWidth];
    uint32_t order[4]; // as in Node; of the other octants the opposite ones' backwards
    uint32_t there;    // bits: places with a child

    float plane(uint32_t axis, uint8_t at) const { return origin[axis] + float(at) * scale[axis]; }
};
static_assert(sizeof(CompactNode) == 128);

// What Node::order is for octants 4 to 7, but that places without a child come first. Eight fields
// of three bits change their places: those of neighbours, of pairs and of halves.
constexpr uint32_t reversed_order(uint32_t order) {
    order = (order & 0x1C71C7u) << 3 | (order >> 3 & 0x1C71C7u);
    order = (order & 0x03F03Fu) << 6 | (order >> 6 & 0x03F03Fu);
    return (order & 0x000FFFu) << 12 | order >> 12;
}
static_assert(reversed_order(0xFAC688) == 0x053977);

// Memory of leaves is counted in these.
struct alignas(8) LeafUnit {
    std::byte bytes[8];
};

// Four triangles: for each corner and lane the place of the vertex in the pool. What the last
// group has beyond the leaf's count repeats the last triangle.
struct LeafGroup {
    uint8_t vertex[3][kBlockWidth];
    uint32_t triangle[kBlockWidth];
};
static_assert(sizeof(LeafGroup) == 28 && alignof(LeafGroup) == 4);

// A leaf. Before the records of a node's leaves lie their pools of vertices, x, y, z each.
struct LeafRecord {
    uint32_t header; // triangles, and above kCountBits how many units before this the pool begins

    static constexpr uint32_t kCountBits = 8;
    static constexpr uint32_t kMostVertices = 256; // of a pool

    uint32_t count() const { return header & ((1u << kCountBits) - 1); }
    uint32_t groups() const { return (count() + kBlockWidth - 1) / kBlockWidth; }
    const LeafGroup* group() const { return reinterpret_cast<const LeafGroup*>(this + 1); }
    const float* pool() const {
        return reinterpret_cast<const float*>(reinterpret_cast<const LeafUnit*>(this)
                                              - (header >> kCountBits));
    }
    static uint32_t units(uint32_t triangles) {
        const uint32_t groups = (triangles + kBlockWidth - 1) / kBlockWidth;
        return uint32_t((sizeof(LeafRecord) + groups * sizeof(LeafGroup) + sizeof(LeafUnit) - 1)
                        / sizeof(LeafUnit));
    }
};
static_assert(sizeof(LeafRecord) == 4);

// Nodes have the numbers of the full tree's.
struct CompactTree {
    explicit CompactTree(base::Memory* memory) : nodes(memory), leaves(memory) {}

    base::Vector<CompactNode> nodes; // empty if there are no triangles, or the tree is not compact
    base::Vector<LeafUnit> leaves;
};

inline const LeafRecord& record_at(const LeafUnit* leaves, Link leaf) {
    return *reinterpret_cast<const LeafRecord*>(leaves + (leaf.bits & ~Link::kLeaf));
}

} // namespace peregrine::accel::bvh
