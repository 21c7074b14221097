// Light by angle and distance: scene/lights/falloff.h for vectors of points. Included once for each
// instruction set.
#if defined(PEREGRINE_SHADE_FALLOFF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_FALLOFF_INL_H
#undef PEREGRINE_SHADE_FALLOFF_INL_H
#else
#define PEREGRINE_SHADE_FALLOFF_INL_H
#endif

#include "shade/light/incidence-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

// cos^2(pi x / 2).
HWY_INLINE Vf lobe_of(Vf x) {
    const Vf one = splat(1.0f);
    const Vf y = hn::Mul(x, x);
    Vf sum = splat(scene::kCosine[2]);
    sum = hn::Add(hn::Mul(sum, y), splat(scene::kCosine[1]));
    sum = hn::Add(hn::Mul(sum, y), splat(scene::kCosine[0]));
    sum = hn::Add(hn::Mul(sum, y), one);
    const Vf cosine = hn::Mul(hn::Sub(one, y), sum);
    return hn::Mul(cosine, cosine);
}

// Those of Arauna by themselves, but for their constants.
template <scene::Falloff Law>
HWY_INLINE Vf paper_falloff(Vf x) {
    const Vf one = splat(1.0f);
    const Vf rest = hn::Max(hn::Sub(one, x), hn::Zero(kF));
    if constexpr (Law == scene::Falloff::schlick_linear)
        return hn::Div(hn::Mul(rest, rest), hn::Add(one, hn::Mul(splat(scene::kSchlickBend), x)));
    else if constexpr (Law == scene::Falloff::cosine_linear)
        return hn::Mul(rest, lobe_of(x));
    else
        return rest;
}

// Cosine times fall-off: with b = normal . to_light, a = min(bend geometric . to_light, b),
//     a (b^2 + a b - a^2) / b^2
// is the cosine with the facets' terminator softened (Chiang, Li, Burley, "Taming the Shadow
// Terminator", SIGGRAPH Talks 2019: G + G^2 - G^3 with G = a / b); on a flat surface it is b. The
// division by |to_light| and that of scene/lights/falloff.h join the one by b^2.
template <class Kind, scene::Falloff Law>
HWY_INLINE Vf weigh_by_one_quotient(const PreparedLight& light, Vf a, Incidence& in) {
    const Vf one = splat(1.0f);
    const Vf b = in.cosine;
    const Vf bb = hn::Mul(b, b);
    Vf above = hn::Mul(a, hn::Sub(hn::Add(bb, hn::Mul(a, b)), hn::Mul(a, a)));
    Vf below = bb;
    if constexpr (Kind::kHasPlace) {
        const Vf x = hn::Mul(in.distance, splat(light.inverse_radius));
        const Vf rest = hn::Sub(one, x);
        below = hn::Mul(bb, in.distance);
        if constexpr (Law == scene::Falloff::schlick_linear) {
            above = hn::Mul(above, hn::Mul(rest, rest));
            below = hn::Mul(below, hn::Add(one, hn::Mul(splat(scene::kSchlickBend), x)));
        } else {
            above = hn::Mul(above, hn::Max(rest, hn::Zero(kF)));
        }
        if constexpr (Law == scene::Falloff::cosine_linear) above = hn::Mul(above, lobe_of(x));
    }
    above = Kind::shape(light, in, above);
    in.lit = hn::And(in.lit, hn::Gt(below, splat(1e-36f))); // else the quotient is no number
    return hn::IfThenElseZero(in.lit, hn::Div(above, below));
}

// The same with the inverse square, for distances from 1e-15 to 1e19: in one quotient the powers of
// |to_light| would over- and underflow long before that.
template <class Kind, scene::Falloff Law>
HWY_INLINE Vf weigh_inverse_square(const PreparedLight& light, Vf a, const Incidence& in) {
    const Vf one = splat(1.0f);
    const Vf g = hn::Div(a, in.cosine);
    const Vf inverse = hn::Min(hn::Div(one, in.distance), splat(light.inverse_nearest));
    const Vf soft = hn::Sub(hn::Add(one, g), hn::Mul(g, g));
    Vf weight = hn::Mul(hn::Mul(hn::Mul(a, inverse), soft), hn::Mul(inverse, inverse));
    if constexpr (Law == scene::Falloff::windowed_inverse_square) {
        const Vf x = hn::Mul(in.distance, splat(light.inverse_radius));
        const Vf xx = hn::Mul(x, x);
        weight = hn::Mul(weight, hn::Max(hn::Sub(one, hn::Mul(xx, xx)), hn::Zero(kF)));
    }
    return hn::IfThenElseZero(in.lit, Kind::shape(light, in, weight));
}

template <class Kind, scene::Falloff Law>
HWY_INLINE Vf weigh_diffuse(const Surface& surface, const PreparedLight& light, uint32_t i,
                            Incidence& in) {
    const Vf a = hn::Min(hn::Mul(hn::LoadU(kF, surface.bend + i), in.geometric), in.cosine);
    if constexpr (Kind::kHasPlace && scene::is_inverse_square(Law))
        return weigh_inverse_square<Kind, Law>(light, a, in);
    else
        return weigh_by_one_quotient<Kind, Law>(light, a, in);
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
