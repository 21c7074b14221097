// A kind of light: a point light with a cone. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_SPOT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_SPOT_INL_H
#undef PEREGRINE_SHADE_SPOT_INL_H
#else
#define PEREGRINE_SHADE_SPOT_INL_H
#endif

#include "shade/light/point-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

// A smooth step of the angle's cosine, from the outer one's on.
HWY_INLINE Vf cone_share(const PreparedLight& light, Vf cosine) {
    const Vf s =
        hn::Min(hn::Mul(hn::Sub(cosine, splat(light.cone_outer_cos)), splat(light.cone_scale)),
                splat(1.0f));
    return hn::Mul(hn::Mul(s, s), hn::Sub(splat(3.0f), hn::Mul(splat(2.0f), s)));
}

struct SpotLight {
    static constexpr bool kHasPlace = true;

    static HWY_INLINE Incidence meet(const Surface& surface, const PreparedLight& light,
                                     uint32_t i) {
        Incidence in = PointLight::meet(surface, light, i);
        const Vf along = dot(splat(light.direction), in.to_light);
        const Vf cosine = hn::Mul(splat(-light.cone_outer_cos), in.distance);
        in.lit = hn::And(in.lit, hn::Lt(along, cosine));
        return in;
    }

    static HWY_INLINE Vf shape(const PreparedLight& light, const Incidence& in, Vf weight) {
        const Vf cosine = hn::Div(hn::Neg(dot(splat(light.direction), in.to_light)), in.distance);
        return hn::Mul(weight, cone_share(light, cosine));
    }
};

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
