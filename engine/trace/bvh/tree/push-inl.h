// The nodes that one ray goes through: which children it enters, and in which
// order. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_TREE_PUSH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_TREE_PUSH_INL_H
#undef PEREGRINE_TRACE_BVH_TREE_PUSH_INL_H
#else
#define PEREGRINE_TRACE_BVH_TREE_PUSH_INL_H
#endif

#include <hwy/highway.h>

#include "math/box.h"
#include "math/ray.h"
#include "simd/lanes-inl.h"
#include "trace/bvh/tree/views-inl.h"

#include <algorithm>
#include <bit>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// A ray's origin and direction, x, y, z and something else, and what they span;
// each number of `reach` and `largest` is in all lanes.
struct RayLanes {
    V4 origin, direction;
    V4 reach;    // the largest distance along an axis from the origin to a corner of
                 // the bounds
    V4 largest;  // component of the direction, without its sign
    uint32_t kz; // its axis, the smaller one of equals

    HWY_INLINE HWY_ATTR RayLanes(const math::Box& bounds, const math::Ray& ray) {
        static_assert(sizeof(math::Box) == 24 && offsetof(math::Ray, direction) == 16);
        origin = hn::LoadU(k4, reinterpret_cast<const float*>(&ray));
        direction = hn::LoadU(k4, reinterpret_cast<const float*>(&ray) + 4);
        const float* corners = reinterpret_cast<const float*>(&bounds);
        const V4 lower = hn::LoadU(k4, corners);
        const V4 upper = hn::Shuffle0321(hn::LoadU(k4, corners + 2));
        reach = largest_of_three(
            hn::Max(hn::Abs(hn::Sub(lower, origin)), hn::Abs(hn::Sub(upper, origin))));
        const V4 size = hn::Abs(direction);
        largest = largest_of_three(size);
        kz = uint32_t(std::countr_zero(bits_of(k4, hn::Eq(size, largest)) | 4u));
    }
};

// The planes of a box, times `inverse`, plus these give where the ray enters
// and leaves it, widened by the margin of trace/slabs.h. Multiplied out, (o +-
// margin) / d is off by 3 e |o / d| (two sums and a product), in addition to
// what slabs.h counts; 4 e |o / d| are added for it.
//
// The first box waits for these numbers, so the chain of operations is short:
// beside the division go the margins, which with |1 / d| outside need no more
// than a product afterwards, and the bound of |1 / d|: 2^26 / |d|_inf or up to
// an eighth more, from the exponent alone.
struct NodeRay {
    V8 inverse[3];
    V8 enter[3], leave[3];
    size_t enter_plane[3], leave_plane[3]; // offsets in a node, in floats

    HWY_INLINE HWY_ATTR explicit NodeRay(const RayLanes& ray) {
        const hn::RebindToUnsigned<D4> u4;
        const V4 signs = hn::And(ray.direction, hn::Set(k4, -0.0f));
        const V4 bound = hn::BitCast(
            k4, hn::Sub(hn::Set(u4, (2 * 127u + 26u) << 23), hn::BitCast(u4, ray.largest)));
        const V4 size = hn::Min(hn::Abs(hn::Div(hn::Set(k4, 1.0f), ray.direction)), bound);
        const V4 along = hn::Xor(ray.origin, signs);
        const V4 rounding = hn::Mul(hn::Set(k4, 0x1p-22f), hn::Abs(ray.origin));
        const V4 scale = hn::Set(k4, 0x1p-20f);
        const V4 behind = hn::MulAdd(ray.reach, scale, hn::Add(rounding, along));
        const V4 ahead = hn::MulAdd(ray.reach, scale, hn::Sub(rounding, along));
        alignas(16) float inverse_of[4], enter_of[4], leave_of[4];
        hn::Store(hn::Or(size, signs), k4, inverse_of);
        hn::Store(hn::Mul(hn::Neg(behind), size), k4, enter_of);
        hn::Store(hn::Mul(ahead, size), k4, leave_of);
        const size_t octant = bits_of(k4, hn::Lt(hn::Or(signs, hn::Set(k4, 1.0f)), hn::Zero(k4)));
        for (size_t k = 0; k < 3; ++k) {
            inverse[k] = hn::Set(k8, inverse_of[k]);
            enter[k] = hn::Set(k8, enter_of[k]);
            leave[k] = hn::Set(k8, leave_of[k]);
            enter_plane[k] = (k + 3 * (octant >> k & 1)) * accel::bvh::kWidth;
            leave_plane[k] = (2 * k + 3) * accel::bvh::kWidth - enter_plane[k];
        }
    }
};

// Where a ray enters and leaves the children of a node, beginning with child `first`.
class Crossings {
public:
    HWY_INLINE HWY_ATTR Crossings(const NodeRay& ray, const Node& node)
        : ray_(ray), planes_(&node.lower[0][0]) {}

    HWY_INLINE HWY_ATTR V8 enter(uint32_t k, size_t first) const {
        return hn::MulAdd(hn::Load(k8, planes_ + ray_.enter_plane[k] + first), ray_.inverse[k],
                          ray_.enter[k]);
    }
    HWY_INLINE HWY_ATTR V8 leave(uint32_t k, size_t first) const {
        return hn::MulAdd(hn::Load(k8, planes_ + ray_.leave_plane[k] + first), ray_.inverse[k],
                          ray_.leave[k]);
    }

private:
    const NodeRay& ray_;
    const float* planes_;
};

// Of a compact node: the ray is taken into the node's frame, so that a plane waits for one
// multiply-add, not two. With W <= 2 D the extent of the bounds, that adds e W / |d| for the
// rounding of `step` and e D / |d| for that of `enter_` and `leave_`, when fused. What slabs.h
// counts for an unfused product is left over: 12.5 - 1 + 3 = 14.5 e D / |d|, and planes up to W /
// 255 outside the bounds make it 14.7 of the 16 that are taken. Where products are not fused,
// decoded planes go the way of the full node's.
class CompactCrossings {
public:
    HWY_INLINE HWY_ATTR CompactCrossings(const NodeRay& ray, const CompactNode& node)
        : ray_(ray), planes_(&node.lower[0][0]) {
        for (uint32_t k = 0; k < 3; ++k) {
            origin_[k] = hn::Set(k8, node.origin[k]);
            scale_[k] = hn::Set(k8, node.scale[k]);
            if (!kFused) continue;
            enter_[k] = hn::MulAdd(origin_[k], ray.inverse[k], ray.enter[k]);
            leave_[k] = hn::MulAdd(origin_[k], ray.inverse[k], ray.leave[k]);
            scale_[k] = hn::Mul(scale_[k], ray.inverse[k]);
        }
    }

    HWY_INLINE HWY_ATTR V8 enter(uint32_t k, size_t first) const {
        const V8 steps = load_bytes(planes_ + ray_.enter_plane[k] + first);
        if (kFused) return hn::MulAdd(steps, scale_[k], enter_[k]);
        return hn::MulAdd(hn::MulAdd(steps, scale_[k], origin_[k]), ray_.inverse[k], ray_.enter[k]);
    }
    HWY_INLINE HWY_ATTR V8 leave(uint32_t k, size_t first) const {
        const V8 steps = load_bytes(planes_ + ray_.leave_plane[k] + first);
        if (kFused) return hn::MulAdd(steps, scale_[k], leave_[k]);
        return hn::MulAdd(hn::MulAdd(steps, scale_[k], origin_[k]), ray_.inverse[k], ray_.leave[k]);
    }

private:
    static constexpr bool kFused = HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3;

    const NodeRay& ray_;
    const uint8_t* planes_;
    V8 origin_[3], scale_[3], enter_[3], leave_[3];
};

// The children of a node that the ray touches in its interval.
struct Entered {
    V8 t_near[accel::bvh::kWidth / kLanes8];
    uint32_t children = 0; // bits

    HWY_INLINE HWY_ATTR Entered(const NodeRay& ray, const Node& node, V8 begin, V8 end) {
        find(Crossings(ray, node), begin, end);
    }
    HWY_INLINE HWY_ATTR Entered(const NodeRay& ray, const CompactNode& node, V8 begin, V8 end) {
        find(CompactCrossings(ray, node), begin, end);
        children &= node.there;
    }

private:
    template <class Planes>
    HWY_INLINE HWY_ATTR void find(const Planes& planes, V8 begin, V8 end) {
        for (size_t first = 0; first < accel::bvh::kWidth; first += kLanes8) {
            const V8 near = hn::Max(hn::Max(planes.enter(0, first), planes.enter(1, first)),
                                    hn::Max(planes.enter(2, first), begin));
            const V8 far = hn::Min(hn::Min(planes.leave(0, first), planes.leave(1, first)),
                                   hn::Min(planes.leave(2, first), end));
            t_near[first / kLanes8] = near;
            children |= bits_of(k8, hn::Le(near, far)) << first;
        }
    }
};

// A child and where the ray enters it, in one number: of those with t >= 0 the
// nearer is smaller. (The order is for speed alone; negative t may come in
// any.)
struct Entry {
    template <class NodeType>
    static uint64_t of(const NodeType& node, const float* t_near, uint32_t child) {
        return uint64_t(std::bit_cast<uint32_t>(t_near[child])) << 32 | node.child[child].bits;
    }
    static float t_near(uint64_t entry) { return std::bit_cast<float>(uint32_t(entry >> 32)); }
    static Link link(uint64_t entry) { return {uint32_t(entry)}; }
};

// Puts all but the nearest of the children on the stack, near ones last, and
// returns the nearest. There is at least one. Most nodes have one or two: those
// take no loop.
template <class View, class NodeType, class Children>
HWY_INLINE HWY_ATTR Link push(const View& view, const NodeType& node, const Children& entered,
                              uint64_t*& top) {
    uint32_t children = entered.children;
    const auto next = [&]() HWY_ATTR {
        const uint32_t child = uint32_t(std::countr_zero(children));
        children &= children - 1;
        return child;
    };
    const uint32_t first = next();
    if (children == 0) return node.child[first];
    const uint32_t second = next();
    for (const Link link : {node.child[first], node.child[second]})
        if (!link.is_leaf()) view.prefetch(link);
    alignas(32) float t_near[accel::bvh::kWidth];
    for (size_t i = 0; i < accel::bvh::kWidth / kLanes8; ++i)
        hn::Store(entered.t_near[i], k8, t_near + i * kLanes8);
    const uint64_t a = Entry::of(node, t_near, first);
    const uint64_t b = Entry::of(node, t_near, second);
    uint64_t nearest = std::min(a, b);
    uint64_t* const bottom = top;
    *top++ = std::max(a, b);
    while (children) {
        const uint64_t entry = Entry::of(node, t_near, next());
        uint64_t far = std::max(entry, nearest);
        nearest = std::min(entry, nearest);
        uint64_t* place = top++;
        for (; place > bottom && place[-1] < far; --place) *place = place[-1];
        *place = far;
    }
    return Entry::link(nearest);
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
