// The canonical test for a facet and the rays of a group. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_DECIDE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_DECIDE_INL_H
#undef PEREGRINE_TRACE_BVH_DECIDE_INL_H
#else
#define PEREGRINE_TRACE_BVH_DECIDE_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/beam-inl.h"
#include "trace/bvh/facet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

// The facet in all lanes: geometry/intersect.h with what rays of a common origin share taken out
// of the loop.
struct Judge {
    V8 x[3], y[3], z[3];
    Vd z_double[3];

    HWY_INLINE HWY_ATTR Judge(const Facets& facets, uint32_t lane) {
        for (int i = 0; i < 3; ++i) {
            x[i] = hn::Set(k8, facets.vertex[i][0][lane]);
            y[i] = hn::Set(k8, facets.vertex[i][1][lane]);
            z[i] = hn::Set(k8, facets.vertex[i][2][lane]);
            z_double[i] = hn::Set(kD, double(facets.vertex[i][2][lane]));
        }
    }
};

struct Verdict {
    V8 t; // NaN: no hit
    V8 u, v;
    V8 det; // its sign
};

// Products of two floats are exact in double, so a fused multiply-subtract rounds as the canonical
// product and difference do.
struct PartOfVerdict {
    hn::Vec<Dfd> t, u, v, det;
};
template <bool Inside>
HWY_INLINE HWY_ATTR PartOfVerdict judge_part(const Judge& facet, Vd ax, Vd ay, Vd bx, Vd by, Vd cx,
                                             Vd cy, Vd dz) {
    const Vd u = hn::MulSub(cx, by, hn::Mul(cy, bx));
    const Vd v = hn::MulSub(ax, cy, hn::Mul(ay, cx));
    const Vd w = hn::MulSub(bx, ay, hn::Mul(by, ax));
    const Vd det = hn::Add(hn::Add(u, v), w);
    const Vd depth = hn::Add(hn::Add(hn::Mul(u, facet.z_double[0]), hn::Mul(v, facet.z_double[1])),
                             hn::Mul(w, facet.z_double[2]));
    // det = 0 gives an infinite r, and then t is infinite or NaN, no hit either.
    const Vd r = hn::Div(hn::Set(kD, 1.0), hn::Mul(det, dz));
    Vd t = hn::Mul(depth, r);
    if (!Inside) {
        const Vd zero = hn::Zero(kD);
        const auto outside = hn::And(hn::Lt(hn::Min(u, hn::Min(v, w)), zero),
                                     hn::Gt(hn::Max(u, hn::Max(v, w)), zero));
        t = hn::IfThenElse(outside, hn::Set(kD, std::numeric_limits<double>::quiet_NaN()), t);
    }
    return {hn::DemoteTo(kFd, t), hn::DemoteTo(kFd, hn::Mul(hn::Mul(v, dz), r)),
            hn::DemoteTo(kFd, hn::Mul(hn::Mul(w, dz), r)), hn::DemoteTo(kFd, det)};
}

// Inside: the edge functions have no sign to ask for.
template <bool Inside>
HWY_INLINE HWY_ATTR Verdict judge(const Judge& facet, V8 sx, V8 sy, V8 dz) {
    const auto shear = [](V8 a, V8 s, V8 z) HWY_ATTR { return hn::Sub(a, hn::Mul(s, z)); };
    const V8 ax = shear(facet.x[0], sx, facet.z[0]), ay = shear(facet.y[0], sy, facet.z[0]);
    const V8 bx = shear(facet.x[1], sx, facet.z[1]), by = shear(facet.y[1], sy, facet.z[1]);
    const V8 cx = shear(facet.x[2], sx, facet.z[2]), cy = shear(facet.y[2], sy, facet.z[2]);
    const auto low = [](V8 a) HWY_ATTR { return hn::PromoteTo(kD, hn::LowerHalf(kFd, a)); };
    const auto high = [](V8 a) HWY_ATTR { return hn::PromoteTo(kD, hn::UpperHalf(kFd, a)); };
    const PartOfVerdict a =
        judge_part<Inside>(facet, low(ax), low(ay), low(bx), low(by), low(cx), low(cy), low(dz));
    const PartOfVerdict b = judge_part<Inside>(facet, high(ax), high(ay), high(bx), high(by),
                                               high(cx), high(cy), high(dz));
    return {hn::Combine(k8, b.t, a.t), hn::Combine(k8, b.u, a.u), hn::Combine(k8, b.v, a.v),
            hn::Combine(k8, b.det, a.det)};
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
