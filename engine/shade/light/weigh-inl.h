// What a light gives to the points of a batch, and the rays that ask whether it gets there.
// Included once for each instruction set.
#if defined(PEREGRINE_SHADE_WEIGH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_WEIGH_INL_H
#undef PEREGRINE_SHADE_WEIGH_INL_H
#else
#define PEREGRINE_SHADE_WEIGH_INL_H
#endif

#include "shade/kernels.h"
#include "shade/light/falloff-inl.h"
#include "simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

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

HWY_INLINE Mf differs(const uint32_t* states, PointState from) {
    return hn::RebindMask(kF, hn::Ne(hn::LoadU(kU, states), hn::Set(kU, uint32_t(from))));
}

template <class Kind, scene::Falloff Law, class Program>
HWY_ATTR uint32_t weigh_light(const Surface& surface, uint32_t count, const PreparedLight& light,
                              const Recalled& recalled, LightWeights& out, const ShadowRays& rays) {
    uint32_t ray_count = 0;
    for (uint32_t i = 0; i < count; i += kLanes) {
        Incidence in = Kind::meet(surface, light, i);
        if (recalled.states)
            in.lit = hn::And(in.lit, differs(recalled.states + i, PointState::hidden));
        if (hn::AllFalse(kF, in.lit)) {
            hn::StoreU(hn::Zero(kF), kF, out.diffuse + i);
            if constexpr (Program::kHasLobe) hn::StoreU(hn::Zero(kF), kF, out.lobe + i);
            continue;
        }
        hn::StoreU(weigh_diffuse<Kind, Law>(surface, light, i, in), kF, out.diffuse + i);
        if constexpr (Program::kHasLobe)
            hn::StoreU(Program::weigh_lobe(surface, i, in), kF, out.lobe + i);
        Mf traced = in.lit;
        if (recalled.states) {
            traced = hn::And(traced, differs(recalled.states + i, PointState::seen));
            if (!recalled.traces_lit)
                traced = hn::And(traced, differs(recalled.states + i, PointState::lit));
        }
        ray_count = pack_rays(surface, i, in, traced, light.from_light, rays, ray_count);
    }
    return ray_count;
}

template <class Program>
HWY_ATTR void add_light(const LightWeights& weights, uint32_t count, const math::Vec3& color,
                        Illumination& sum) {
    const V3 c = splat(color);
    for (uint32_t i = 0; i < count; i += kLanes) {
        const V3 light = scale(c, hn::LoadU(kF, weights.diffuse + i));
        store(add(load(sum.irradiance, i), light), sum.irradiance, i);
        if constexpr (Program::kHasLobe) {
            const V3 lobe = scale(light, hn::LoadU(kF, weights.lobe + i));
            store(add(load(sum.highlight, i), lobe), sum.highlight, i);
        }
    }
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
