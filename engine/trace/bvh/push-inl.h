// The stack of a traversal, and how the children that a ray enters get there. Included once for
// each instruction set.
#if defined(PEREGRINE_TRACE_BVH_PUSH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_PUSH_INL_H
#undef PEREGRINE_TRACE_BVH_PUSH_INL_H
#else
#define PEREGRINE_TRACE_BVH_PUSH_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "trace/bvh/lanes-inl.h"

#include <array>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using accel::bvh::Link;
using accel::bvh::Node;

// Eight places more than the depth of the tree can fill: whole vectors are stored.
struct Stack {
    uint32_t depth = 0;
    uint32_t link[accel::bvh::kStackSize + accel::bvh::kWidth];
    float t_near[accel::bvh::kStackSize + accel::bvh::kWidth];
};

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
// For each set of children the set ones, in order, three bits each.
constexpr std::array<uint32_t, 256> make_packing() {
    std::array<uint32_t, 256> table{};
    for (uint32_t bits = 0; bits < 256; ++bits)
        for (uint32_t child = 0, place = 0; child < 8; ++child)
            if (bits >> child & 1) table[bits] |= child << 3 * place++;
    return table;
}
inline constexpr std::array<uint32_t, 256> kPacking = make_packing();

// Without a branch on how many children there are: brings all eight into the order of the octant,
// far ones first, packs those that are entered, and stores eight (Fuetterer et al., "Accelerated
// Single Ray Tracing for Wide Vector Units", HPG 2017).
class Children {
public:
    HWY_ATTR Children(const Node& node, uint32_t octant) : node_(node), octant_(octant) {}

    HWY_INLINE HWY_ATTR void set(size_t, M8 entered, V8 t_near) {
        entered_ = entered;
        t_near_ = t_near;
    }

    HWY_INLINE HWY_ATTR void push(Stack& stack) const {
        const hn::RebindToUnsigned<D8> u8;
        alignas(32) static constexpr uint32_t kBackToFront[8] = {21, 18, 15, 12, 9, 6, 3, 0};
        alignas(32) static constexpr uint32_t kInOrder[8] = {0, 3, 6, 9, 12, 15, 18, 21};
        const auto seven = hn::Set(u8, 7);
        const auto order =
            hn::And(hn::Shr(hn::Set(u8, node_.order[octant_]), hn::Load(u8, kBackToFront)), seven);
        const auto to_order = hn::IndicesFromVec(k8, order);
        const M8 entered =
            hn::MaskFromVec(hn::TableLookupLanes(hn::VecFromMask(k8, entered_), to_order));
        const uint32_t bits = bits_of(k8, entered);
        const auto packing =
            hn::And(hn::Shr(hn::Set(u8, kPacking[bits]), hn::Load(u8, kInOrder)), seven);
        const auto packed = hn::TableLookupLanes(order, hn::IndicesFromVec(u8, packing));
        const auto link = hn::Load(u8, &node_.child[0].bits);
        hn::StoreU(hn::TableLookupLanes(link, hn::IndicesFromVec(u8, packed)), u8,
                   stack.link + stack.depth);
        hn::StoreU(hn::TableLookupLanes(t_near_, hn::IndicesFromVec(k8, packed)), k8,
                   stack.t_near + stack.depth);
        stack.depth += uint32_t(__builtin_popcount(bits));
    }

private:
    const Node& node_;
    uint32_t octant_;
    M8 entered_;
    V8 t_near_;
};
#else
class Children {
public:
    HWY_ATTR Children(const Node& node, uint32_t octant) : node_(node), octant_(octant) {}

    HWY_INLINE HWY_ATTR void set(size_t first, M8 entered, V8 t_near) {
        entered_ |= bits_of(k8, entered) << first;
        hn::Store(t_near, k8, t_near_ + first);
    }

    HWY_INLINE HWY_ATTR void push(Stack& stack) const {
        if (entered_ == 0) return;
        const uint32_t order = node_.order[octant_];
        for (uint32_t shift = 24; shift > 0;) {
            shift -= 3;
            const uint32_t child = order >> shift & 7;
            stack.link[stack.depth] = node_.child[child].bits;
            stack.t_near[stack.depth] = t_near_[child];
            stack.depth += entered_ >> child & 1;
        }
    }

private:
    const Node& node_;
    uint32_t octant_;
    uint32_t entered_ = 0;
    alignas(32) float t_near_[accel::bvh::kWidth];
};
#endif

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
