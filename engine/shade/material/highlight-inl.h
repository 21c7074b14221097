// A material program: matt with a highlight (material/highlight.h). Included once for each
// instruction set.
#if defined(PEREGRINE_SHADE_HIGHLIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_HIGHLIGHT_INL_H
#undef PEREGRINE_SHADE_HIGHLIGHT_INL_H
#else
#define PEREGRINE_SHADE_HIGHLIGHT_INL_H
#endif

#include "shade/light/incidence-inl.h"
#include "shade/material/matt-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

struct Highlight {
    static constexpr bool kHasLobe = true;

    // material/highlight.h with t = mirror . to_light / |to_light|.
    static HWY_INLINE Vf weigh_lobe(const Surface& surface, uint32_t i, const Incidence& in) {
        const Vf t = dot(load(surface.mirror, i), in.to_light);
        const Vf n = hn::LoadU(kF, surface.shininess + i);
        const Vf below = hn::Sub(hn::Mul(n, in.distance), hn::Mul(hn::Sub(n, splat(1.0f)), t));
        const Mf lit = hn::And(in.lit, hn::Gt(t, hn::Zero(kF)));
        return hn::IfThenElseZero(hn::And(lit, hn::Gt(below, hn::Zero(kF))), hn::Div(t, below));
    }

    static HWY_INLINE V3 reflect(const Surface& surface, const Illumination& light, const V3& in,
                                 uint32_t i) {
        return add(Matt::reflect(surface, light, in, i),
                   multiply(load(surface.specular, i), load(light.highlight, i)));
    }
};

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
