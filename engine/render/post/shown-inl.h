// Radiance as it will be shown. Included once for each instruction set.
#if defined(PEREGRINE_RENDER_POST_SHOWN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_RENDER_POST_SHOWN_INL_H
#undef PEREGRINE_RENDER_POST_SHOWN_INL_H
#else
#define PEREGRINE_RENDER_POST_SHOWN_INL_H
#endif

#include "render/post/kernels.h"
#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::render::post::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

HWY_INLINE Vf multiply_add(Vf x, float factor, float term) {
    return hn::Add(hn::Mul(x, splat(factor)), splat(term));
}

// As post/display_curve.h has it.
HWY_INLINE Vf filmic(Vf x) {
    const Vf above = hn::Mul(x, multiply_add(x, 2.51f, 0.03f));
    const Vf below = hn::Add(hn::Mul(x, multiply_add(x, 2.43f, 0.59f)), splat(0.14f));
    return hn::Div(above, below);
}

// x >= 0.
HWY_INLINE Vf display_value(ToneMapping tones, Vf x) {
    switch (tones) {
    case ToneMapping::filmic:
        return filmic(x);
    case ToneMapping::clamp:
        return x;
    default:
        return hn::Div(x, hn::Add(splat(1.0f), x));
    }
}

HWY_ATTR void to_shown(ToneMapping tones, float exposure, const float* radiance, uint32_t count,
                       float* shown) {
    for (uint32_t i = 0; i < count; i += kLanes) {
        const Vf x = hn::Mul(hn::LoadU(kF, radiance + i), splat(exposure));
        // Not a number: 0. Beyond 1e9 the curves are flat; infinity would give none.
        const Vf positive = hn::IfThenElseZero(hn::Gt(x, splat(0.0f)), x);
        const Vf finite = hn::IfThenElse(hn::Lt(positive, splat(1e9f)), positive, splat(1e9f));
        const Vf value = hn::Min(display_value(tones, finite), splat(1.0f));
        hn::StoreU(hn::Sqrt(value), kF, shown + i);
    }
}

} // namespace peregrine::render::post::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
