// How kernels see the tree: full, compact, or either, with a branch each time. Kernels of which
// one ray pays for such a branch are compiled for each of the first two. Included once for each
// instruction set.
#if defined(PEREGRINE_TRACE_BVH_TREE_VIEWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_TREE_VIEWS_INL_H
#undef PEREGRINE_TRACE_BVH_TREE_VIEWS_INL_H
#else
#define PEREGRINE_TRACE_BVH_TREE_VIEWS_INL_H
#endif

#include <hwy/highway.h>

#include "simd/lanes-inl.h"
#include "trace/bvh/tree/decode-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Which children are leaves: bits.
template <class NodeType>
HWY_INLINE HWY_ATTR uint32_t leaves_of(const NodeType& node) {
    const hn::RebindToSigned<D8> i8;
    static_assert(Link::kLeaf == 0x80000000u);
    uint32_t bits = 0;
    for (size_t first = 0; first < kWidth; first += kLanes8) {
        const auto link = hn::LoadU(i8, reinterpret_cast<const int32_t*>(&node.child[first]));
        bits |= bits_of(i8, hn::Lt(link, hn::Zero(i8))) << first;
    }
    return bits;
}

// Rooms belong to one visit of a node or a leaf.
class FullView {
public:
    using NodeType = Node;

    HWY_INLINE explicit FullView(const Target& target) : target_(target) {}

    HWY_INLINE const Node& node(Link link) const { return tree_of(target_).nodes[link.node()]; }
    HWY_INLINE Leaf leaf(Link link, LeafRoom&) const {
        return {tree_of(target_).blocks + link.first_block(), link.count()};
    }
    HWY_INLINE HWY_ATTR void prefetch(Link inner) const {
        prefetch_lines(&node(inner), sizeof(Node) / 64);
    }

private:
    const Target& target_;
};

class CompactView {
public:
    using NodeType = CompactNode;

    HWY_INLINE explicit CompactView(const Target& target) : target_(target) {}

    HWY_INLINE const CompactNode& node(Link link) const {
        return tree_of(target_).compact_nodes[link.node()];
    }
    HWY_INLINE HWY_ATTR Leaf leaf(Link link, LeafRoom& room) const {
        return decode_leaf(accel::bvh::record_at(tree_of(target_).compact_leaves, link),
                           room.blocks);
    }
    HWY_INLINE HWY_ATTR void prefetch(Link inner) const {
        prefetch_lines(&node(inner), sizeof(CompactNode) / 64);
    }

private:
    const Target& target_;
};

class EitherView {
public:
    using NodeType = Node;

    HWY_INLINE explicit EitherView(const Target& target) : target_(target) {}

    HWY_INLINE HWY_ATTR const Node& node(Link link) {
        return fetch_node(target_, link.node(), room_);
    }
    HWY_INLINE HWY_ATTR void prefetch(Link inner) const {
        if (tree_of(target_).is_compact())
            prefetch_lines(tree_of(target_).compact_nodes + inner.node(), sizeof(CompactNode) / 64);
        else
            prefetch_lines(tree_of(target_).nodes + inner.node(), sizeof(Node) / 64);
    }

private:
    const Target& target_;
    Node room_;
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
