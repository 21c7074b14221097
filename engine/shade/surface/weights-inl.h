// Values of a triangle's vertices, blended at barycentrics. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_WEIGHTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_WEIGHTS_INL_H
#undef PEREGRINE_SHADE_WEIGHTS_INL_H
#else
#define PEREGRINE_SHADE_WEIGHTS_INL_H
#endif

#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Weights of the vertices at barycentrics (u, v).
struct Weights {
    Vf w0, w1, w2;
};

HWY_INLINE Weights weights(const float* u, const float* v, uint32_t i) {
    const Vf w1 = hn::LoadU(kF, u + i), w2 = hn::LoadU(kF, v + i);
    return {hn::Sub(hn::Sub(splat(1.0f), w1), w2), w1, w2};
}

HWY_INLINE Vf blend(const Weights& w, float a, float b, float c) {
    return hn::Add(hn::Add(hn::Mul(w.w0, splat(a)), hn::Mul(w.w1, splat(b))),
                   hn::Mul(w.w2, splat(c)));
}

HWY_INLINE V3 blend(const Weights& w, const math::Vec3* v) {
    return {blend(w, v[0].x, v[1].x, v[2].x), blend(w, v[0].y, v[1].y, v[2].y),
            blend(w, v[0].z, v[1].z, v[2].z)};
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
