// geometry/intersect.h in vectors, lane by lane the same operations in the same order. A lane is a
// ray and a triangle. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_CANONICAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_CANONICAL_INL_H
#undef PEREGRINE_TRACE_CANONICAL_INL_H
#else
#define PEREGRINE_TRACE_CANONICAL_INL_H
#endif

#include <hwy/highway.h>

#include "simd/lanes-inl.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Step 3: a coordinate of a corner, relative to the origin, sheared along the ray.
template <class V>
HWY_INLINE HWY_ATTR V shear(V a, V slope, V z) {
    return hn::Sub(a, hn::Mul(slope, z));
}

// Corners relative to the ray.
template <class V>
struct Sheared {
    V ax, ay, az, bx, by, bz, cx, cy, cz;

    HWY_INLINE HWY_ATTR V u() const { return hn::Sub(hn::Mul(cx, by), hn::Mul(cy, bx)); }
    HWY_INLINE HWY_ATTR V v() const { return hn::Sub(hn::Mul(ax, cy), hn::Mul(ay, cx)); }
    HWY_INLINE HWY_ATTR V w() const { return hn::Sub(hn::Mul(bx, ay), hn::Mul(by, ax)); }
};

// The float filter: lanes that are missed for certain.
template <class V>
HWY_INLINE HWY_ATTR auto outside(V u, V v, V w) {
    const V zero = hn::Xor(u, u);
    return hn::And(hn::Lt(hn::Min(u, hn::Min(v, w)), zero),
                   hn::Gt(hn::Max(u, hn::Max(v, w)), zero));
}
template <class V>
HWY_INLINE HWY_ATTR auto outside(const Sheared<V>& s) {
    return outside(s.u(), s.v(), s.w());
}

// Steps 4 to 6, but for the range of t. V: of doubles.
template <class V>
struct Decided {
    using D = hn::Rebind<float, hn::DFromV<V>>;
    hn::Vec<D> t; // NaN: no hit
    hn::Vec<D> u, v;
    hn::Vec<D> det; // its sign; not of t, which is that of det and dz together
};

// Products of two floats are exact in double, so a fused multiply-subtract rounds as the canonical
// product and difference do. Inside: the edge functions are known to agree in sign.
template <bool Inside, class V>
HWY_INLINE HWY_ATTR Decided<V> decide(V ax, V ay, V bx, V by, V cx, V cy, V az, V bz, V cz, V dz) {
    constexpr hn::DFromV<V> d;
    constexpr typename Decided<V>::D f;
    const V u = hn::MulSub(cx, by, hn::Mul(cy, bx));
    const V v = hn::MulSub(ax, cy, hn::Mul(ay, cx));
    const V w = hn::MulSub(bx, ay, hn::Mul(by, ax));
    const V det = hn::Add(hn::Add(u, v), w);
    const V depth = hn::Add(hn::Add(hn::Mul(u, az), hn::Mul(v, bz)), hn::Mul(w, cz));
    // Where the signs agree and det is 0, all are 0, and t is 0 times infinity: NaN, no hit.
    const V r = hn::Div(hn::Set(d, 1.0), hn::Mul(det, dz));
    V t = hn::Mul(depth, r);
    if (!Inside)
        t = hn::IfThenElse(outside(u, v, w), hn::Set(d, std::numeric_limits<double>::quiet_NaN()),
                           t);
    return {hn::DemoteTo(f, t), hn::DemoteTo(f, hn::Mul(hn::Mul(v, dz), r)),
            hn::DemoteTo(f, hn::Mul(hn::Mul(w, dz), r)), hn::DemoteTo(f, det)};
}

} // namespace peregrine::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
