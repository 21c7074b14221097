// Nodes and leaves for the kernels, whether the BVH is compact or not. Included once for each
// instruction set.
#if defined(PEREGRINE_TRACE_BVH_TREE_DECODE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_TREE_DECODE_INL_H
#undef PEREGRINE_TRACE_BVH_TREE_DECODE_INL_H
#else
#define PEREGRINE_TRACE_BVH_TREE_DECODE_INL_H
#endif

#include <hwy/highway.h>

#include "simd/lanes-inl.h"
#include "simd/memory-inl.h"
#include "trace/bvh/tree/decode.h"

#include <cstring>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

using accel::bvh::kWidth;

// All but the order of octants 4 to 7. As in CompactNode::plane products are exact, so they may be
// fused.
HWY_NOINLINE HWY_ATTR inline void decode_node(const CompactNode& in, Node& out) {
    const V8 infinity = hn::Set(k8, std::numeric_limits<float>::infinity());
    for (uint32_t axis = 0; axis < 3; ++axis) {
        const V8 origin = hn::Set(k8, in.origin[axis]), scale = hn::Set(k8, in.scale[axis]);
        for (size_t first = 0; first < kWidth; first += kLanes8) {
            V8 lower = hn::MulAdd(load_bytes(in.lower[axis] + first), scale, origin);
            V8 upper = hn::MulAdd(load_bytes(in.upper[axis] + first), scale, origin);
            if (axis == 0) {
                const M8 there = mask_of(in.there >> first);
                lower = hn::IfThenElse(there, lower, infinity);
                upper = hn::IfThenElse(there, upper, hn::Neg(infinity));
            }
            hn::Store(lower, k8, out.lower[axis] + first);
            hn::Store(upper, k8, out.upper[axis] + first);
        }
    }
    std::memcpy(out.child, in.child, sizeof in.child);
    std::memcpy(out.order, in.order, sizeof in.order);
}

HWY_INLINE HWY_ATTR void decode_group(const LeafGroup& in, const float* pool, Block& out) {
    const hn::RebindToUnsigned<D4> u4;
    for (uint32_t corner = 0; corner < 3; ++corner) {
        // A vertex and what follows it.
        const auto vertex = [&](uint32_t lane) HWY_ATTR __attribute__((always_inline)) {
            return hn::LoadU(k4, pool + 3 * size_t(in.vertex[corner][lane]));
        };
        const V4 a = vertex(0), b = vertex(1), c = vertex(2), d = vertex(3);
        const V4 ac = hn::InterleaveLower(k4, a, c), bd = hn::InterleaveLower(k4, b, d);
        const V4 ac_z = hn::InterleaveUpper(k4, a, c), bd_z = hn::InterleaveUpper(k4, b, d);
        hn::Store(hn::InterleaveLower(k4, ac, bd), k4, out.vertex[corner][0]);
        hn::Store(hn::InterleaveUpper(k4, ac, bd), k4, out.vertex[corner][1]);
        hn::Store(hn::InterleaveLower(k4, ac_z, bd_z), k4, out.vertex[corner][2]);
    }
    hn::Store(hn::LoadU(u4, in.triangle), u4, out.triangle);
}

HWY_INLINE HWY_ATTR Leaf decode_leaf(const LeafRecord& record, Block* room) {
    const float* pool = record.pool();
    const uint32_t groups = record.groups();
    for (uint32_t i = 0; i < groups; ++i) decode_group(record.group()[i], pool, room[i]);
    return {room, record.count()};
}

// In a function of its own: kernels for either tree stay as small as they are for the full one.
HWY_NOINLINE HWY_ATTR inline Leaf decode_leaf_apart(const LeafRecord& record, Block* room) {
    return decode_leaf(record, room);
}

HWY_INLINE HWY_ATTR const Node& fetch_node(const Target& target, uint32_t index, Node& room) {
    if (!tree_of(target).is_compact()) return tree_of(target).nodes[index];
    decode_node(tree_of(target).compact_nodes[index], room);
    return room;
}

HWY_INLINE HWY_ATTR Leaf fetch_leaf(const Target& target, Link link, Block* room) {
    if (!tree_of(target).is_compact())
        return {tree_of(target).blocks + link.first_block(), link.count()};
    return decode_leaf_apart(accel::bvh::record_at(tree_of(target).compact_leaves, link), room);
}
HWY_INLINE HWY_ATTR Leaf fetch_leaf(const Target& target, Link link, LeafRoom& room) {
    return fetch_leaf(target, link, room.blocks);
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
