// Which children of a node a beam enters. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_CHILDREN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_CHILDREN_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_CHILDREN_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_CHILDREN_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "simd/lanes-inl.h"
#include "trace/bvh/beam/beam-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

using accel::bvh::Node;

// The children of a node that a window's rays may enter.
struct BeamChildren {
    uint32_t entered;                  // bits
    uint32_t narrow;                   // bits: those that groups should be asked about one by one
    uint32_t tiny;                     // bits: those that few rays enter, to be asked one by one
    alignas(32) float near[8], far[8]; // z, cut to the beam's
    alignas(32) float x0[8], x1[8], y0[8], y1[8];

    HWY_INLINE HWY_ATTR void find(const Beam& beam, const Node& node, const Window& window,
                                  float limit, float tiny_side);
    // Slopes through a child that lies ahead as a whole, from the beam's centre.
    HWY_INLINE HWY_ATTR Window window_of(const Beam& beam, uint32_t child) const {
        const float near_inverse = 1 / near[child], far_inverse = 1 / far[child];
        const float slack = 1.0f + 0x1p-21f;
        return {std::min(x0[child] * near_inverse * slack, x0[child] * far_inverse) - beam.center_p,
                std::max(x1[child] * near_inverse * slack, x1[child] * far_inverse) - beam.center_p,
                std::min(y0[child] * near_inverse * slack, y0[child] * far_inverse) - beam.center_q,
                std::max(y1[child] * near_inverse * slack, y1[child] * far_inverse)
                    - beam.center_q};
    }
    // The groups of `mask` whose rays may enter a child.
    HWY_INLINE HWY_ATTR uint32_t find_groups(const Beam& beam, uint32_t child, uint32_t mask) const;
};

HWY_INLINE HWY_ATTR void BeamChildren::find(const Beam& beam, const Node& node,
                                            const Window& window, float limit, float tiny_side) {
    entered = narrow = tiny = 0;
    const bool ahead = beam.sign > 0;
    const float* z_first = ahead ? node.lower[beam.kz] : node.upper[beam.kz];
    const float* z_last = ahead ? node.upper[beam.kz] : node.lower[beam.kz];
    const V8 sign = hn::Set(k8, beam.sign);
    const V8 oz = hn::Set(k8, beam.sign * beam.origin[2]);
    const V8 margin = hn::Set(k8, beam.margin);
    const V8 ox = hn::Set(k8, beam.origin[0]), oy = hn::Set(k8, beam.origin[1]);
    const V8 p0 = hn::Set(k8, window.p0 + beam.center_p),
             p1 = hn::Set(k8, window.p1 + beam.center_p);
    const V8 q0 = hn::Set(k8, window.q0 + beam.center_q),
             q1 = hn::Set(k8, window.q1 + beam.center_q);
    const V8 wide_p = hn::Mul(hn::Set(k8, 0.5f), hn::Sub(p1, p0));
    const V8 wide_q = hn::Mul(hn::Set(k8, 0.5f), hn::Sub(q1, q0));
    const V8 tiny_p = hn::Set(k8, tiny_side * (beam.window.p1 - beam.window.p0));
    const V8 tiny_q = hn::Set(k8, tiny_side * (beam.window.q1 - beam.window.q0));
    for (size_t i = 0; i < accel::bvh::kWidth; i += kLanes8) {
        const V8 za = hn::Sub(hn::Mul(hn::Load(k8, z_first + i), sign), hn::Add(oz, margin));
        const V8 zb = hn::Sub(hn::Mul(hn::Load(k8, z_last + i), sign), hn::Sub(oz, margin));
        const V8 begin = hn::Max(za, hn::Set(k8, beam.near));
        const V8 end = hn::Min(zb, hn::Set(k8, limit));
        const V8 left = hn::Sub(hn::Sub(hn::Load(k8, node.lower[beam.kx] + i), ox), margin);
        const V8 right = hn::Add(hn::Sub(hn::Load(k8, node.upper[beam.kx] + i), ox), margin);
        const V8 bottom = hn::Sub(hn::Sub(hn::Load(k8, node.lower[beam.ky] + i), oy), margin);
        const V8 top = hn::Add(hn::Sub(hn::Load(k8, node.upper[beam.ky] + i), oy), margin);
        // Of the wedge between two slopes, the box must reach beyond neither side.
        const auto in_p = hn::And(hn::Ge(right, hn::Min(hn::Mul(p0, begin), hn::Mul(p0, end))),
                                  hn::Le(left, hn::Max(hn::Mul(p1, begin), hn::Mul(p1, end))));
        const auto in_q = hn::And(hn::Ge(top, hn::Min(hn::Mul(q0, begin), hn::Mul(q0, end))),
                                  hn::Le(bottom, hn::Max(hn::Mul(q1, begin), hn::Mul(q1, end))));
        const auto in = hn::And(hn::Le(begin, end), hn::And(in_p, in_q));
        entered |= bits_of(k8, in) << i;
        const auto small = hn::Or(hn::Lt(hn::Sub(right, left), hn::Mul(wide_p, begin)),
                                  hn::Lt(hn::Sub(top, bottom), hn::Mul(wide_q, begin)));
        narrow |= bits_of(k8, small) << i;
        const auto few = hn::And(hn::Lt(hn::Sub(right, left), hn::Mul(tiny_p, begin)),
                                 hn::Lt(hn::Sub(top, bottom), hn::Mul(tiny_q, begin)));
        tiny |= bits_of(k8, few) << i;
        hn::Store(begin, k8, near + i);
        hn::Store(end, k8, far + i);
        hn::Store(left, k8, x0 + i);
        hn::Store(right, k8, x1 + i);
        hn::Store(bottom, k8, y0 + i);
        hn::Store(top, k8, y1 + i);
    }
}

HWY_INLINE HWY_ATTR uint32_t BeamChildren::find_groups(const Beam& beam, uint32_t child,
                                                       uint32_t mask) const {
    const V8 begin = hn::Set(k8, near[child]), end = hn::Set(k8, far[child]);
    const V8 left = hn::Set(k8, x0[child]), right = hn::Set(k8, x1[child]);
    const V8 bottom = hn::Set(k8, y0[child]), top = hn::Set(k8, y1[child]);
    const V8 cp = hn::Set(k8, beam.center_p), cq = hn::Set(k8, beam.center_q);
    uint32_t bits = 0;
    for (uint32_t g = 0; g < kGroups; g += kLanes8) {
        const V8 p0 = hn::Add(hn::Load(k8, beam.group_p0 + g), cp);
        const V8 p1 = hn::Add(hn::Load(k8, beam.group_p1 + g), cp);
        const V8 q0 = hn::Add(hn::Load(k8, beam.group_q0 + g), cq);
        const V8 q1 = hn::Add(hn::Load(k8, beam.group_q1 + g), cq);
        const auto in_p = hn::And(hn::Ge(right, hn::Min(hn::Mul(p0, begin), hn::Mul(p0, end))),
                                  hn::Le(left, hn::Max(hn::Mul(p1, begin), hn::Mul(p1, end))));
        const auto in_q = hn::And(hn::Ge(top, hn::Min(hn::Mul(q0, begin), hn::Mul(q0, end))),
                                  hn::Le(bottom, hn::Max(hn::Mul(q1, begin), hn::Mul(q1, end))));
        const auto open = hn::Ge(hn::Load(k8, beam.group_limit + g), begin);
        bits |= bits_of(k8, hn::And(open, hn::And(in_p, in_q))) << g;
    }
    return bits & mask;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
