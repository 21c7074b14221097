// Vectors of vectors: a lane is a point or a direction. Included once for each instruction set.
#if defined(PEREGRINE_SIMD_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SIMD_VECTORS_INL_H
#undef PEREGRINE_SIMD_VECTORS_INL_H
#else
#define PEREGRINE_SIMD_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::simd::HWY_NAMESPACE {

template <class V>
struct Vec3 {
    V x, y, z;
};

template <class V>
HWY_INLINE HWY_ATTR Vec3<V> operator-(const Vec3<V>& a, const Vec3<V>& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

// Products may be fused: for filters, not for what must have the same bits everywhere.
template <class V>
HWY_INLINE HWY_ATTR V dot(const Vec3<V>& a, const Vec3<V>& b) {
    return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
template <class V>
HWY_INLINE HWY_ATTR Vec3<V> cross(const Vec3<V>& a, const Vec3<V>& b) {
    return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
            hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

// The largest component, without its sign.
template <class V>
HWY_INLINE HWY_ATTR V largest(const Vec3<V>& v) {
    return hn::Max(hn::Abs(v.x), hn::Max(hn::Abs(v.y), hn::Abs(v.z)));
}

} // namespace peregrine::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
