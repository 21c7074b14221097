#pragma once

#include "trace/bvh/target.h"

#include <algorithm>
#include <limits>

// Nodes and leaves of the compact BVH as the kernels want them: those of the full one. In plain
// C++; decode-inl.h does the same with SIMD.
namespace peregrine::trace::bvh {

using accel::bvh::Block;
using accel::bvh::CompactNode;
using accel::bvh::LeafGroup;
using accel::bvh::LeafRecord;
using accel::bvh::LeafUnit;
using accel::bvh::Link;
using accel::bvh::Node;

// Blocks in a row.
struct Leaf {
    const Block* blocks;
    uint32_t count; // triangles
};

// Room for a decoded leaf.
struct LeafRoom {
    Block blocks[accel::bvh::kMaxLeaf / accel::bvh::kBlockWidth];
};

// All but the order of octants 4 to 7.
inline void decode(const CompactNode& in, Node& out) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (uint32_t i = 0; i < accel::bvh::kWidth; ++i) {
        for (uint32_t axis = 0; axis < 3; ++axis) {
            out.lower[axis][i] = in.plane(axis, in.lower[axis][i]);
            out.upper[axis][i] = in.plane(axis, in.upper[axis][i]);
        }
        out.child[i] = in.child[i];
        if (in.there >> i & 1) continue;
        out.lower[0][i] = kInfinity;
        out.upper[0][i] = -kInfinity;
    }
    std::copy_n(in.order, 4, out.order);
}

inline void decode(const LeafGroup& in, const float* pool, Block& out) {
    for (uint32_t lane = 0; lane < accel::bvh::kBlockWidth; ++lane) {
        for (uint32_t corner = 0; corner < 3; ++corner)
            for (uint32_t axis = 0; axis < 3; ++axis)
                out.vertex[corner][axis][lane] = pool[3 * in.vertex[corner][lane] + axis];
        out.triangle[lane] = in.triangle[lane];
    }
}

inline const Node& plain_node(const Target& target, uint32_t index, Node& room) {
    if (!tree_of(target).is_compact()) return tree_of(target).nodes[index];
    decode(tree_of(target).compact_nodes[index], room);
    return room;
}

inline Leaf plain_leaf(const Target& target, Link link, LeafRoom& room) {
    if (!tree_of(target).is_compact())
        return {tree_of(target).blocks + link.first_block(), link.count()};
    const LeafRecord& record = accel::bvh::record_at(tree_of(target).compact_leaves, link);
    for (uint32_t i = 0; i < record.groups(); ++i)
        decode(record.group()[i], record.pool(), room.blocks[i]);
    return {room.blocks, record.count()};
}

} // namespace peregrine::trace::bvh
