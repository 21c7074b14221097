// Which children of a node a beam of parallel rays enters. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_PARALLEL_CHILDREN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_PARALLEL_CHILDREN_INL_H
#undef PEREGRINE_TRACE_BVH_PARALLEL_CHILDREN_INL_H
#else
#define PEREGRINE_TRACE_BVH_PARALLEL_CHILDREN_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "simd/lanes-inl.h"
#include "trace/bvh/parallel/parallel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

using accel::bvh::Node;

// As BeamChildren. A box fills a window and a range of z; windows are widened by the margin.
struct ParallelChildren {
    uint32_t entered; // bits
    uint32_t narrow;  // bits: those that groups should be asked about one by one
    uint32_t tiny;    // bits: those that few rays enter, to be asked one by one
    alignas(32) float near[8];
    alignas(32) float x0[8], x1[8], y0[8], y1[8];

    HWY_INLINE HWY_ATTR void find(const ParallelBeam& beam, const Node& node, const Window& window,
                                  float limit, float tiny_side);
    HWY_INLINE HWY_ATTR Window window_of(const ParallelBeam&, uint32_t child) const {
        return {x0[child], x1[child], y0[child], y1[child]};
    }
    // The groups of `mask` whose rays may enter a child.
    HWY_INLINE HWY_ATTR uint32_t find_groups(const ParallelBeam& beam, uint32_t child,
                                             uint32_t mask) const;
};

HWY_INLINE HWY_ATTR void ParallelChildren::find(const ParallelBeam& beam, const Node& node,
                                                const Window& window, float limit,
                                                float tiny_side) {
    entered = narrow = tiny = 0;
    const V8 cx = hn::Set(k8, beam.center[0]), cy = hn::Set(k8, beam.center[1]),
             cz = hn::Set(k8, beam.center[2]);
    const V8 sx = hn::Set(k8, beam.sx), sy = hn::Set(k8, beam.sy);
    const V8 margin = hn::Set(k8, beam.margin);
    const V8 wide_p = hn::Set(k8, 0.5f * (window.p1 - window.p0));
    const V8 wide_q = hn::Set(k8, 0.5f * (window.q1 - window.q0));
    const V8 tiny_p = hn::Set(k8, tiny_side * (beam.window.p1 - beam.window.p0));
    const V8 tiny_q = hn::Set(k8, tiny_side * (beam.window.q1 - beam.window.q0));
    for (size_t i = 0; i < accel::bvh::kWidth; i += kLanes8) {
        const V8 low = hn::Sub(hn::Load(k8, node.lower[beam.kz] + i), cz);
        const V8 high = hn::Sub(hn::Load(k8, node.upper[beam.kz] + i), cz);
        const V8 begin = hn::Sub(beam.turn > 0 ? low : hn::Neg(high), margin);
        const V8 end = hn::Add(beam.turn > 0 ? high : hn::Neg(low), margin);
        const auto least = [&](const float* lower, V8 center, V8 slope, bool falls) HWY_ATTR {
            const V8 x = hn::Sub(hn::Load(k8, lower + i), center);
            return hn::Sub(hn::NegMulAdd(slope, falls ? low : high, x), margin);
        };
        const auto most = [&](const float* upper, V8 center, V8 slope, bool falls) HWY_ATTR {
            const V8 x = hn::Sub(hn::Load(k8, upper + i), center);
            return hn::Add(hn::NegMulAdd(slope, falls ? high : low, x), margin);
        };
        const V8 left = least(node.lower[beam.kx], cx, sx, beam.sx < 0);
        const V8 right = most(node.upper[beam.kx], cx, sx, beam.sx < 0);
        const V8 bottom = least(node.lower[beam.ky], cy, sy, beam.sy < 0);
        const V8 top = most(node.upper[beam.ky], cy, sy, beam.sy < 0);
        // A place without a child gives infinities, or NaN where a slope is 0.
        const auto in_p =
            hn::And(hn::Ge(right, hn::Set(k8, window.p0)), hn::Le(left, hn::Set(k8, window.p1)));
        const auto in_q =
            hn::And(hn::Ge(top, hn::Set(k8, window.q0)), hn::Le(bottom, hn::Set(k8, window.q1)));
        const auto in_z =
            hn::And(hn::Le(begin, hn::Set(k8, limit)), hn::Ge(end, hn::Set(k8, beam.near)));
        entered |= bits_of(k8, hn::And(in_z, hn::And(in_p, in_q))) << i;
        const V8 width = hn::Sub(right, left), height = hn::Sub(top, bottom);
        narrow |= bits_of(k8, hn::Or(hn::Lt(width, wide_p), hn::Lt(height, wide_q))) << i;
        tiny |= bits_of(k8, hn::And(hn::Lt(width, tiny_p), hn::Lt(height, tiny_q))) << i;
        hn::Store(begin, k8, near + i);
        hn::Store(left, k8, x0 + i);
        hn::Store(right, k8, x1 + i);
        hn::Store(bottom, k8, y0 + i);
        hn::Store(top, k8, y1 + i);
    }
}

HWY_INLINE HWY_ATTR uint32_t ParallelChildren::find_groups(const ParallelBeam& beam, uint32_t child,
                                                           uint32_t mask) const {
    const V8 begin = hn::Set(k8, near[child]);
    const V8 left = hn::Set(k8, x0[child]), right = hn::Set(k8, x1[child]);
    const V8 bottom = hn::Set(k8, y0[child]), top = hn::Set(k8, y1[child]);
    uint32_t bits = 0;
    for (uint32_t g = 0; g < kGroups; g += kLanes8) {
        const auto in_p = hn::And(hn::Ge(right, hn::Load(k8, beam.group_p0 + g)),
                                  hn::Le(left, hn::Load(k8, beam.group_p1 + g)));
        const auto in_q = hn::And(hn::Ge(top, hn::Load(k8, beam.group_q0 + g)),
                                  hn::Le(bottom, hn::Load(k8, beam.group_q1 + g)));
        const auto open = hn::Ge(hn::Load(k8, beam.group_limit + g), begin);
        bits |= bits_of(k8, hn::And(open, hn::And(in_p, in_q))) << g;
    }
    return bits & mask;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
