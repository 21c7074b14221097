// From surfaces to radiance. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_LIGHTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_LIGHTS_INL_H
#undef PEREGRINE_SHADE_LIGHTS_INL_H
#else
#define PEREGRINE_SHADE_LIGHTS_INL_H
#endif

#include "shade/compress-inl.h"
#include "shade/kernels.h"
#include "shade/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

// What a light does at a point, before visibility. Lengths are in units of |to_light|.
struct Incidence {
    V3 to_light;  // not normalised: shadow rays reach from t = 0 to 1
    Vf distance;  // |to_light|
    Vf cosine;    // normal . to_light
    Vf geometric; // the same with the geometric normal
    Mf lit;
};

template <scene::LightType Type>
HWY_INLINE Incidence find_incidence(const Surface& surface, const PreparedLight& light,
                                    uint32_t i) {
    Incidence in;
    const V3 normal = load(surface.normal, i), geometric = load(surface.geometric, i);
    if constexpr (Type == scene::LightType::directional)
        in.to_light = splat(-light.direction);
    else
        in.to_light = subtract(splat(light.position), load(surface.position, i));
    in.cosine = dot(normal, in.to_light);
    in.geometric = dot(geometric, in.to_light);
    in.lit = hn::And(hn::Gt(in.cosine, hn::Zero(kF)), hn::Gt(in.geometric, hn::Zero(kF)));
    if constexpr (Type == scene::LightType::directional) {
        in.distance = splat(1.0f);
    } else {
        in.distance = hn::Sqrt(dot(in.to_light, in.to_light));
        in.lit = hn::And(in.lit, hn::Lt(in.distance, splat(light.radius)));
    }
    if constexpr (Type == scene::LightType::spot) {
        const Vf along = dot(splat(light.direction), in.to_light);
        const Vf cosine = hn::Mul(splat(-light.cone_outer_cos), in.distance);
        in.lit = hn::And(in.lit, hn::Lt(along, cosine));
    }
    return in;
}

// The spot's share: a smooth step of the angle's cosine.
HWY_INLINE Vf weigh_cone(const PreparedLight& light, const Incidence& in) {
    const Vf cosine = hn::Div(hn::Neg(dot(splat(light.direction), in.to_light)), in.distance);
    const Vf s =
        hn::Min(hn::Mul(hn::Sub(cosine, splat(light.cone_outer_cos)), splat(light.cone_scale)),
                splat(1.0f));
    return hn::Mul(hn::Mul(s, s), hn::Sub(splat(3.0f), hn::Mul(splat(2.0f), s)));
}

// Cosine times fall-off: with b = normal . to_light, a = min(bend geometric . to_light, b),
//     a (b^2 + a b - a^2) / b^2
// is the cosine with the facets' terminator softened (Chiang, Li, Burley, "Taming the Shadow
// Terminator", SIGGRAPH Talks 2019: G + G^2 - G^3 with G = a / b); on a flat surface it is b. The
// division by |to_light| and that of shade/falloff.h join the one by b^2.
template <scene::LightType Type, scene::Falloff Kind>
HWY_INLINE Vf weigh_by_one_quotient(const PreparedLight& light, Vf a, Incidence& in) {
    const Vf one = splat(1.0f);
    const Vf b = in.cosine;
    const Vf bb = hn::Mul(b, b);
    Vf above = hn::Mul(a, hn::Sub(hn::Add(bb, hn::Mul(a, b)), hn::Mul(a, a)));
    Vf below = bb;
    if constexpr (Type != scene::LightType::directional) {
        const Vf x = hn::Mul(in.distance, splat(light.inverse_radius));
        const Vf rest = hn::Sub(one, x);
        below = hn::Mul(bb, in.distance);
        if constexpr (Kind == scene::Falloff::schlick_linear) {
            above = hn::Mul(above, hn::Mul(rest, rest));
            below = hn::Mul(below, hn::Add(one, hn::Mul(splat(kSchlickBend), x)));
        } else {
            above = hn::Mul(above, hn::Max(rest, hn::Zero(kF)));
        }
        if constexpr (Kind == scene::Falloff::cosine_linear) {
            const Vf y = hn::Mul(x, x);
            Vf sum = splat(kCosine[2]);
            sum = hn::Add(hn::Mul(sum, y), splat(kCosine[1]));
            sum = hn::Add(hn::Mul(sum, y), splat(kCosine[0]));
            sum = hn::Add(hn::Mul(sum, y), one);
            const Vf cosine = hn::Mul(hn::Sub(one, y), sum);
            above = hn::Mul(above, hn::Mul(cosine, cosine));
        }
    }
    if constexpr (Type == scene::LightType::spot) above = hn::Mul(above, weigh_cone(light, in));
    in.lit = hn::And(in.lit, hn::Gt(below, splat(1e-36f))); // else the quotient is no number
    return hn::IfThenElseZero(in.lit, hn::Div(above, below));
}

// The same with the inverse square, for distances from 1e-15 to 1e19: in one quotient the powers of
// |to_light| would over- and underflow long before that.
template <scene::LightType Type, scene::Falloff Kind>
HWY_INLINE Vf weigh_inverse_square(const PreparedLight& light, Vf a, const Incidence& in) {
    const Vf one = splat(1.0f);
    const Vf g = hn::Div(a, in.cosine);
    const Vf inverse = hn::Min(hn::Div(one, in.distance), splat(light.inverse_nearest));
    const Vf soft = hn::Sub(hn::Add(one, g), hn::Mul(g, g));
    Vf weight = hn::Mul(hn::Mul(hn::Mul(a, inverse), soft), hn::Mul(inverse, inverse));
    if constexpr (Kind == scene::Falloff::windowed_inverse_square) {
        const Vf x = hn::Mul(in.distance, splat(light.inverse_radius));
        const Vf xx = hn::Mul(x, x);
        weight = hn::Mul(weight, hn::Max(hn::Sub(one, hn::Mul(xx, xx)), hn::Zero(kF)));
    }
    if constexpr (Type == scene::LightType::spot) weight = hn::Mul(weight, weigh_cone(light, in));
    return hn::IfThenElseZero(in.lit, weight);
}

template <scene::LightType Type, scene::Falloff Kind>
HWY_INLINE Vf weigh_diffuse(const Surface& surface, const PreparedLight& light, uint32_t i,
                            Incidence& in) {
    const Vf a = hn::Min(hn::Mul(hn::LoadU(kF, surface.bend + i), in.geometric), in.cosine);
    if constexpr (Type != scene::LightType::directional && is_inverse_square(Kind))
        return weigh_inverse_square<Type, Kind>(light, a, in);
    else
        return weigh_by_one_quotient<Type, Kind>(light, a, in);
}

// shade/highlight.h with t = mirror . to_light / |to_light|.
HWY_INLINE Vf weigh_lobe(const Surface& surface, uint32_t i, const Incidence& in) {
    const Vf t = dot(load(surface.mirror, i), in.to_light);
    const Vf n = hn::LoadU(kF, surface.shininess + i);
    const Vf below = hn::Sub(hn::Mul(n, in.distance), hn::Mul(hn::Sub(n, splat(1.0f)), t));
    const Mf lit = hn::And(in.lit, hn::Gt(t, hn::Zero(kF)));
    return hn::IfThenElseZero(hn::And(lit, hn::Gt(below, hn::Zero(kF))), hn::Div(t, below));
}

// Rays that start at the light get their origins all at once, elsewhere.
HWY_INLINE uint32_t pack_rays(const Surface& surface, uint32_t i, const Incidence& in, Mf traced,
                              bool from_light, const ShadowRays& rays, uint32_t count) {
    const Compressor lit(traced);
    if (!from_light) {
        const V3 p = load(surface.position, i);
        hn::StoreU(lit.pack(p.x), kF, rays.origin[0] + count);
        hn::StoreU(lit.pack(p.y), kF, rays.origin[1] + count);
        hn::StoreU(lit.pack(p.z), kF, rays.origin[2] + count);
    }
    const V3 along = scale(in.to_light, splat(from_light ? -1.0f : 1.0f));
    hn::StoreU(lit.pack(along.x), kF, rays.direction[0] + count);
    hn::StoreU(lit.pack(along.y), kF, rays.direction[1] + count);
    hn::StoreU(lit.pack(along.z), kF, rays.direction[2] + count);
    const Vf index = lit.pack(hn::BitCast(kF, hn::Iota(kU, i)));
    hn::StoreU(hn::BitCast(kU, index), kU, rays.index + count);
    return count + uint32_t(hn::CountTrue(kF, traced));
}

HWY_INLINE Mf differs(const uint32_t* states, trace::visibility::State from) {
    return hn::RebindMask(kF, hn::Ne(hn::LoadU(kU, states), hn::Set(kU, uint32_t(from))));
}

template <scene::LightType Type, scene::Falloff Kind, bool Specular>
HWY_ATTR uint32_t weigh_light(const Surface& surface, uint32_t count, const PreparedLight& light,
                              const Recalled& recalled, LightWeights& out, const ShadowRays& rays) {
    using trace::visibility::State;
    uint32_t ray_count = 0;
    for (uint32_t i = 0; i < count; i += kLanes) {
        Incidence in = find_incidence<Type>(surface, light, i);
        if (recalled.states) in.lit = hn::And(in.lit, differs(recalled.states + i, State::hidden));
        if (hn::AllFalse(kF, in.lit)) {
            hn::StoreU(hn::Zero(kF), kF, out.diffuse + i);
            if constexpr (Specular) hn::StoreU(hn::Zero(kF), kF, out.lobe + i);
            continue;
        }
        hn::StoreU(weigh_diffuse<Type, Kind>(surface, light, i, in), kF, out.diffuse + i);
        if constexpr (Specular) hn::StoreU(weigh_lobe(surface, i, in), kF, out.lobe + i);
        Mf traced = in.lit;
        if (recalled.states && !recalled.traces_lit)
            traced = hn::And(traced, differs(recalled.states + i, State::lit));
        ray_count = pack_rays(surface, i, in, traced, light.from_light, rays, ray_count);
    }
    return ray_count;
}

template <bool Specular>
HWY_ATTR void add_light(const LightWeights& weights, uint32_t count, const math::Vec3& color,
                        Illumination& sum) {
    const V3 c = splat(color);
    for (uint32_t i = 0; i < count; i += kLanes) {
        const V3 light = scale(c, hn::LoadU(kF, weights.diffuse + i));
        store(add(load(sum.irradiance, i), light), sum.irradiance, i);
        if constexpr (Specular) {
            const V3 lobe = scale(light, hn::LoadU(kF, weights.lobe + i));
            store(add(load(sum.highlight, i), lobe), sum.highlight, i);
        }
    }
}

HWY_INLINE V3 multiply(const V3& a, const V3& b) {
    return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}

// Arauna's model of shading (section 2): ambient + diffuse + specular + emissive.
template <bool Specular, bool Emissive>
HWY_ATTR void combine(const Surface& surface, const Illumination& light, const RayHits& hits,
                      const scene::Environment& environment, float* const radiance[3]) {
    const Vf inverse_pi = splat(0.31830988618f);
    const V3 ambient = splat(environment.ambient), background = splat(environment.background);
    for (uint32_t i = 0; i < hits.count; i += kLanes) {
        const V3 in = add(ambient, scale(load(light.irradiance, i), inverse_pi));
        V3 out = multiply(load(surface.albedo, i), in);
        if constexpr (Specular)
            out = add(out, multiply(load(surface.specular, i), load(light.highlight, i)));
        if constexpr (Emissive) out = add(out, load(surface.emissive, i));
        const auto missed = hn::RebindMask(
            kF, hn::Eq(hn::LoadU(kU, hits.triangle + i), hn::Set(kU, geometry::kNoTriangle)));
        out = select(missed, background, out);
        hn::StoreU(out.x, kF, radiance[0] + i);
        hn::StoreU(out.y, kF, radiance[1] + i);
        hn::StoreU(out.z, kF, radiance[2] + i);
    }
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
