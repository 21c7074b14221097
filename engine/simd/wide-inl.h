// As many floats as the machine takes at a time, and three such vectors to a point. Nothing is
// fused. Included once for each instruction set.
#if defined(PEREGRINE_SIMD_WIDE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SIMD_WIDE_INL_H
#undef PEREGRINE_SIMD_WIDE_INL_H
#else
#define PEREGRINE_SIMD_WIDE_INL_H
#endif

#include <hwy/highway.h>

#include "math/vec.h"

// Every operation is lane by lane and rounds once (no FMA, no estimates), so the number of lanes
// does not show in the image.
HWY_BEFORE_NAMESPACE();
namespace peregrine::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Df = hn::ScalableTag<float>;
using Du = hn::ScalableTag<uint32_t>;
using Di = hn::ScalableTag<int32_t>;
using Vf = hn::Vec<Df>;
using Vu = hn::Vec<Du>;
using Vi = hn::Vec<Di>;
using Mf = hn::Mask<Df>;
inline constexpr Df kF;
inline constexpr Du kU;
inline constexpr Di kI;
inline constexpr uint32_t kLanes = uint32_t(HWY_LANES(float));

struct V3 {
    Vf x, y, z;
};

HWY_INLINE Vf splat(float value) {
    return hn::Set(kF, value);
}
HWY_INLINE V3 splat(const math::Vec3& v) {
    return {splat(v.x), splat(v.y), splat(v.z)};
}

template <size_t Count>
HWY_INLINE V3 load(const float (*lanes)[Count], uint32_t i) {
    return {hn::LoadU(kF, lanes[0] + i), hn::LoadU(kF, lanes[1] + i), hn::LoadU(kF, lanes[2] + i)};
}

template <size_t Count>
HWY_INLINE void store(const V3& v, float (*lanes)[Count], uint32_t i) {
    hn::StoreU(v.x, kF, lanes[0] + i);
    hn::StoreU(v.y, kF, lanes[1] + i);
    hn::StoreU(v.z, kF, lanes[2] + i);
}

HWY_INLINE V3 add(const V3& a, const V3& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

HWY_INLINE V3 subtract(const V3& a, const V3& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE V3 scale(const V3& a, Vf s) {
    return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}

HWY_INLINE V3 multiply(const V3& a, const V3& b) {
    return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}

HWY_INLINE Vf dot(const V3& a, const V3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE V3 cross(const V3& a, const V3& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
            hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

HWY_INLINE V3 select(Mf mask, const V3& yes, const V3& no) {
    return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
            hn::IfThenElse(mask, yes.z, no.z)};
}

// `fallback` where v has no length to speak of, or one that is not finite.
HWY_INLINE V3 normalize(const V3& v, const V3& fallback) {
    const Vf square = dot(v, v);
    const Mf usable = hn::And(hn::Gt(square, splat(1e-30f)), hn::Lt(square, splat(1e30f)));
    return select(usable, scale(v, hn::Div(splat(1.0f), hn::Sqrt(square))), fallback);
}

// v, or -v where `sign` is negative.
HWY_INLINE V3 flip(const V3& v, Vf sign) {
    const Vf bit = hn::And(sign, hn::SignBit(kF));
    return {hn::Xor(v.x, bit), hn::Xor(v.y, bit), hn::Xor(v.z, bit)};
}

} // namespace peregrine::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
