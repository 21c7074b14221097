// The nodes that one ray goes through: which children it enters, and in which
// order. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_PUSH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_PUSH_INL_H
#undef PEREGRINE_TRACE_BVH_PUSH_INL_H
#else
#define PEREGRINE_TRACE_BVH_PUSH_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "math/box.h"
#include "math/ray.h"
#include "trace/lanes-inl.h"

#include <algorithm>
#include <bit>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace trace::HWY_NAMESPACE;

using accel::bvh::Link;
using accel::bvh::Node;

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

    static HWY_INLINE HWY_ATTR V4 largest_of_three(V4 v) {
        return hn::Max(hn::Broadcast<0>(v), hn::Max(hn::Broadcast<1>(v), hn::Broadcast<2>(v)));
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

// The children of a node that the ray touches in its interval.
struct Entered {
    V8 t_near[accel::bvh::kWidth / kLanes8];
    uint32_t children = 0; // bits

    HWY_INLINE HWY_ATTR Entered(const NodeRay& ray, const Node& node, V8 begin, V8 end) {
        const float* planes = &node.lower[0][0];
        for (size_t first = 0; first < accel::bvh::kWidth; first += kLanes8) {
            const auto enter = [&](uint32_t k) HWY_ATTR {
                return hn::MulAdd(hn::Load(k8, planes + ray.enter_plane[k] + first), ray.inverse[k],
                                  ray.enter[k]);
            };
            const auto leave = [&](uint32_t k) HWY_ATTR {
                return hn::MulAdd(hn::Load(k8, planes + ray.leave_plane[k] + first), ray.inverse[k],
                                  ray.leave[k]);
            };
            const V8 near = hn::Max(hn::Max(enter(0), enter(1)), hn::Max(enter(2), begin));
            const V8 far = hn::Min(hn::Min(leave(0), leave(1)), hn::Min(leave(2), end));
            t_near[first / kLanes8] = near;
            children |= bits_of(k8, hn::Le(near, far)) << first;
        }
    }
};

// Which children are leaves: bits.
HWY_INLINE HWY_ATTR uint32_t leaves_of(const Node& node) {
    const hn::RebindToSigned<D8> i8;
    static_assert(Link::kLeaf == 0x80000000u);
    uint32_t bits = 0;
    for (size_t first = 0; first < accel::bvh::kWidth; first += kLanes8) {
        const auto link = hn::Load(i8, reinterpret_cast<const int32_t*>(&node.child[first]));
        bits |= bits_of(i8, hn::Lt(link, hn::Zero(i8))) << first;
    }
    return bits;
}

// A child and where the ray enters it, in one number: of those with t >= 0 the
// nearer is smaller. (The order is for speed alone; negative t may come in
// any.)
struct Entry {
    static uint64_t of(const Node& node, const float* t_near, uint32_t child) {
        return uint64_t(std::bit_cast<uint32_t>(t_near[child])) << 32 | node.child[child].bits;
    }
    static float t_near(uint64_t entry) { return std::bit_cast<float>(uint32_t(entry >> 32)); }
    static Link link(uint64_t entry) { return {uint32_t(entry)}; }
};

HWY_INLINE HWY_ATTR void fetch(const Node& node) {
    for (size_t line = 0; line < sizeof(Node); line += 64)
        hwy::Prefetch(reinterpret_cast<const char*>(&node) + line);
}

// Puts all but the nearest of the children on the stack, near ones last, and
// returns the nearest. There is at least one. Most nodes have one or two: those
// take no loop.
template <class Children>
HWY_INLINE HWY_ATTR Link push(const Node* nodes, const Node& node, const Children& entered,
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
        if (!link.is_leaf()) fetch(nodes[link.node()]);
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
