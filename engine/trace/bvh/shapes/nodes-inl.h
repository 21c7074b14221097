// Shapes against eight boxes at a time. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_SHAPES_NODES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_SHAPES_NODES_INL_H
#undef PEREGRINE_TRACE_BVH_SHAPES_NODES_INL_H
#else
#define PEREGRINE_TRACE_BVH_SHAPES_NODES_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "simd/lanes-inl.h"
#include "trace/bvh/tree/push-inl.h"
#include "trace/shapes/volume.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// The children of a node that something reaches, and when: smaller is sooner, and not negative.
struct Reached {
    V8 t_near[accel::bvh::kWidth / kLanes8];
    uint32_t children = 0; // bits
};

// A moving volume. Multiplied out, the planes' times are off by 3 e |o / d| more than volume.h
// counts (cf. NodeRay).
struct MovingGate {
    V8 inverse[3];
    V8 enter[3], leave[3];
    size_t enter_plane[3], leave_plane[3]; // offsets in a node, in floats

    HWY_INLINE HWY_ATTR MovingGate(const Volume& volume, double reach) {
        const Slabs<float> s = slabs<float>(volume, reach, 0);
        for (size_t k = 0; k < 3; ++k) {
            const float from = s.origin[k] * s.inverse[k];
            const float margin = s.margin[k] + 0x1p-22f * std::fabs(from);
            inverse[k] = hn::Set(k8, s.inverse[k]);
            enter[k] = hn::Set(k8, -from - margin);
            leave[k] = hn::Set(k8, margin - from);
            const bool backwards = s.inverse[k] < 0;
            enter_plane[k] = (k + (backwards ? 3 : 0)) * accel::bvh::kWidth;
            leave_plane[k] = (2 * k + 3) * accel::bvh::kWidth - enter_plane[k];
        }
    }

    HWY_INLINE HWY_ATTR Reached reached(const Node& node, float t_max) const {
        Reached out;
        const float* planes = &node.lower[0][0];
        for (size_t first = 0; first < accel::bvh::kWidth; first += kLanes8) {
            const auto at = [&](const size_t* plane, const V8* offset, size_t k) HWY_ATTR
                __attribute__((always_inline)) {
                return hn::MulAdd(hn::Load(k8, planes + plane[k] + first), inverse[k], offset[k]);
            };
            const V8 near = hn::Max(hn::Max(at(enter_plane, enter, 0), at(enter_plane, enter, 1)),
                                    hn::Max(at(enter_plane, enter, 2), hn::Zero(k8)));
            const V8 far = hn::Min(hn::Min(at(leave_plane, leave, 0), at(leave_plane, leave, 1)),
                                   hn::Min(at(leave_plane, leave, 2), hn::Set(k8, t_max)));
            out.t_near[first / kLanes8] = near;
            out.children |= bits_of(k8, hn::Le(near, far)) << first;
        }
        return out;
    }
};

// A ball, or a box, at rest; what is near comes first. `limit` is the square of the radius,
// widened.
struct BallGate {
    V8 center[3];

    HWY_INLINE HWY_ATTR explicit BallGate(const Volume& volume) {
        for (int k = 0; k < 3; ++k) center[k] = hn::Set(k8, float(volume.origin[k]));
    }

    HWY_INLINE HWY_ATTR Reached reached(const Node& node, float limit) const {
        Reached out;
        for (size_t first = 0; first < accel::bvh::kWidth; first += kLanes8) {
            const auto gap = [&](size_t k) HWY_ATTR __attribute__((always_inline)) {
                const V8 below = hn::Sub(hn::Load(k8, node.lower[k] + first), center[k]);
                const V8 above = hn::Sub(center[k], hn::Load(k8, node.upper[k] + first));
                return hn::Max(hn::Max(below, above), hn::Zero(k8));
            };
            const V8 x = gap(0), y = gap(1), z = gap(2);
            const V8 square = hn::MulAdd(z, z, hn::MulAdd(y, y, hn::Mul(x, x)));
            out.t_near[first / kLanes8] = square;
            out.children |= bits_of(k8, hn::Le(square, hn::Set(k8, limit))) << first;
        }
        return out;
    }
};

struct BoxGate {
    V8 lower[3], upper[3];

    HWY_INLINE HWY_ATTR BoxGate(const Volume& volume, double reach) {
        const double error = 0x1p-17 * reach + 0x1p-146;
        for (int k = 0; k < 3; ++k) {
            lower[k] = hn::Set(k8, float(volume.origin[k] - volume.extent[k] - error));
            upper[k] = hn::Set(k8, float(volume.origin[k] + volume.extent[k] + error));
        }
    }

    HWY_INLINE HWY_ATTR Reached reached(const Node& node, float) const {
        Reached out;
        for (size_t first = 0; first < accel::bvh::kWidth; first += kLanes8) {
            const auto meets = [&](size_t k) HWY_ATTR __attribute__((always_inline)) {
                return hn::And(hn::Le(hn::Load(k8, node.lower[k] + first), upper[k]),
                               hn::Ge(hn::Load(k8, node.upper[k] + first), lower[k]));
            };
            const auto all = hn::And(meets(0), hn::And(meets(1), meets(2)));
            out.t_near[first / kLanes8] = hn::Zero(k8);
            out.children |= bits_of(k8, all) << first;
        }
        return out;
    }
};

// Goes through the nodes that the gate lets through up to `limit`, roughly from near to far.
// `leaf(link)` may lower the limit, and returns true to stop.
template <class Gate, class Visit>
HWY_INLINE HWY_ATTR void visit_reached(const Target& target, const Gate& gate, const float& limit,
                                       Visit&& leaf) {
    EitherView view(target);
    uint64_t stack[accel::bvh::kStackSize];
    uint64_t* top = stack;
    Link link = Link::inner(0);
    for (;;) {
        if (!link.is_leaf()) {
            const Node& node = view.node(link);
            hwy::Prefetch(node.child);
            const Reached reached = gate.reached(node, limit);
            if (reached.children) {
                link = push(view, node, reached, top);
                continue;
            }
        } else if (leaf(link)) {
            return;
        }
        do {
            if (top == stack) return;
            --top;
        } while (Entry::t_near(*top) > limit);
        link = Entry::link(*top);
    }
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
