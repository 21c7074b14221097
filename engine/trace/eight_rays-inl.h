// The canonical test for eight rays and a triangle. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_EIGHT_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_EIGHT_RAYS_INL_H
#undef PEREGRINE_TRACE_EIGHT_RAYS_INL_H
#else
#define PEREGRINE_TRACE_EIGHT_RAYS_INL_H
#endif

#include <hwy/highway.h>

#include "geometry/triangle.h"
#include "simd/lanes-inl.h"
#include "trace/canonical-inl.h"
#include "trace/filter.h"
#include "trace/kernels.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

constexpr float kLargestFloat = std::numeric_limits<float>::max();

struct EightHits {
    M8 lanes;
    V8 t, u, v;
    V8u back; // kBackFaceKey where the side seen is the clockwise one, else 0
};

// Of a triangle that eight rays hit.
HWY_INLINE HWY_ATTR V8u keys_of(uint32_t index, const EightHits& hits) {
    return hn::Or(hn::Set(k8u, index), hits.back);
}

// What keys say once the best are known.
struct Named {
    V8u triangle, back_face; // kNoTriangle and 0 for a miss
    M8 missed;

    HWY_INLINE HWY_ATTR explicit Named(V8u keys) {
        const auto none = hn::Eq(keys, hn::Set(k8u, geometry::kNoTriangle));
        missed = hn::RebindMask(k8, none);
        triangle = hn::IfThenElse(none, keys, hn::AndNot(hn::Set(k8u, kBackFaceKey), keys));
        back_face = hn::IfThenZeroElse(none, hn::ShiftRight<31>(keys));
    }
};

// Of the lanes of `maybe` those that are hit within [t_min, t_max]. `decide(part)` is Decided of
// what part(V8) takes of eight lanes.
template <class Decide>
HWY_INLINE HWY_ATTR EightHits decide_parts(Decide&& decide, V8 dz, M8 maybe, V8 t_min, V8 t_max) {
    EightHits hits;
    V8 det;
    if constexpr (kHalves) {
        const auto low = decide([](V8 x) HWY_ATTR { return promote_low(x); });
        const auto high = decide([](V8 x) HWY_ATTR { return promote_high(x); });
        hits.t = hn::Combine(k8, high.t, low.t);
        hits.u = hn::Combine(k8, high.u, low.u);
        hits.v = hn::Combine(k8, high.v, low.v);
        det = hn::Combine(k8, high.det, low.det);
    } else {
        const auto all = decide([](auto x) HWY_ATTR { return hn::PromoteTo(DHalf(), x); });
        hits.t = all.t;
        hits.u = all.u;
        hits.v = all.v;
        det = all.det;
    }
    const V8 end = hn::Min(t_max, hn::Set(k8, kLargestFloat));
    hits.lanes = hn::And(maybe, hn::And(hn::Ge(hits.t, t_min), hn::Le(hits.t, end)));
    hits.back = hn::And(hn::BitCast(k8u, hn::Xor(det, dz)), hn::Set(k8u, kBackFaceKey));
    return hits;
}

HWY_INLINE HWY_ATTR EightHits decide(const Sheared<V8>& s, V8 dz, M8 maybe, V8 t_min, V8 t_max) {
    const auto of = [&](auto part) HWY_ATTR __attribute__((always_inline)) {
        return decide<false>(part(s.ax), part(s.ay), part(s.bx), part(s.by), part(s.cx), part(s.cy),
                             part(s.az), part(s.bz), part(s.cz), part(dz));
    };
    return decide_parts(of, dz, maybe, t_min, t_max);
}

// comes_first of trace/kernels.h, lane by lane.
HWY_INLINE HWY_ATTR M8 comes_first(V8 t, V8u key, V8 best_t, V8u best) {
    const M8 smaller = hn::RebindMask(k8, hn::Lt(key, best));
    return hn::Or(hn::Lt(t, best_t), hn::And(hn::Eq(t, best_t), smaller));
}

// The lanes of `lanes` whose hit is on a present part of a masked surface.
HWY_INLINE HWY_ATTR M8 present(M8 lanes, const AlphaTest& alpha,
                               const geometry::TriangleInfo& triangle, const EightHits& hit) {
    alignas(64) float u[kLanes8], v[kLanes8], kept[kLanes8];
    hn::Store(hit.u, k8, u);
    hn::Store(hit.v, k8, v);
    const uint32_t bits = bits_of(k8, lanes);
    for (size_t i = 0; i < kLanes8; ++i) {
        const bool keep = (bits >> i & 1) && alpha.present(alpha.context, triangle, u[i], v[i]);
        kept[i] = keep ? 1.0f : 0.0f;
    }
    return hn::Gt(hn::Load(k8, kept), hn::Zero(k8));
}

// The lanes of `lanes` whose hit the filter accepts: Filter::accepts, lane by lane.
HWY_INLINE HWY_ATTR M8 accepted(M8 lanes, const Filter& filter,
                                const geometry::TriangleInfo& triangle, const EightHits& hit) {
    if (!filter.sees_mesh(triangle)) return hn::FirstN(k8, 0);
    const M8 back = hn::RebindMask(k8, hn::Ne(hit.back, hn::Zero(k8u)));
    if (!filter.sees_back(triangle)) lanes = hn::AndNot(back, lanes);
    if (!filter.sees_front()) lanes = hn::And(back, lanes);
    if (filter.asks_alpha(triangle)) lanes = present(lanes, filter.alpha, triangle, hit);
    return lanes;
}

} // namespace peregrine::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
