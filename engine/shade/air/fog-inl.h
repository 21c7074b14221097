// Fog along rays. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_FOG_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_FOG_INL_H
#undef PEREGRINE_SHADE_FOG_INL_H
#else
#define PEREGRINE_SHADE_FOG_INL_H
#endif

#include "shade/kernels.h"
#include "shade/path/fresnel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

constexpr float kHorizon = 1e7f; // metres: where rays end that hit nothing

// Density at heights and its mean between two of them, in parts of the largest. No part of it
// divides by the slope of a ray, which may be none: densities are averaged over heights, and a
// difference of heights is divided by one that is not smaller.
struct FogDensity {
    Vf top, bottom, thinning;

    explicit HWY_INLINE FogDensity(const FogLayer& layer)
        : top(splat(layer.top)), bottom(splat(layer.bottom)), thinning(splat(layer.thinning)) {}

    HWY_INLINE Vf within(Vf height) const { return hn::Max(hn::Min(height, top), bottom); }
    // Of a height within the layer.
    HWY_INLINE Vf at(Vf height) const {
        return hn::Min(hn::Mul(hn::Sub(top, height), thinning), splat(1.0f));
    }
    HWY_INLINE Vf at_any(Vf height) const {
        return hn::IfThenElse(hn::Gt(height, bottom), at(hn::Min(height, top)), splat(1.0f));
    }
    HWY_INLINE Vf mean(Vf from, Vf to) const {
        const Vf rise = hn::Abs(hn::Sub(to, from));
        const Vf full = hn::Abs(hn::Sub(hn::Min(to, bottom), hn::Min(from, bottom)));
        const Vf a = within(from), b = within(to);
        const Vf thin =
            hn::Mul(hn::Abs(hn::Sub(b, a)), hn::Mul(hn::Add(at(a), at(b)), splat(0.5f)));
        const Vf level = hn::IfThenElse(hn::Gt(from, bottom), at(a), splat(1.0f));
        const Mf is_level = hn::Eq(rise, hn::Zero(kF));
        return hn::IfThenElse(
            is_level, level,
            hn::Div(hn::Add(full, thin), hn::IfThenElse(is_level, splat(1.0f), rise)));
    }
};

// Beer's law.
HWY_ATTR void find_clear(const FogLayer& layer, const float* heights,
                         const float* const direction[3], const float* t, uint32_t count,
                         float* clear) {
    const FogDensity density(layer);
    for (uint32_t i = 0; i < count; i += kLanes) {
        const V3 d{hn::LoadU(kF, direction[0] + i), hn::LoadU(kF, direction[1] + i),
                   hn::LoadU(kF, direction[2] + i)};
        const Vf length = hn::Sqrt(dot(d, d));
        const Vf metres = hn::Min(hn::Mul(hn::LoadU(kF, t + i), length), splat(kHorizon));
        const Vf from = hn::LoadU(kF, heights + i);
        const Vf to = hn::Add(from, hn::Mul(hn::Div(d.y, length), metres));
        const Vf depth = hn::Mul(splat(layer.density), hn::Mul(metres, density.mean(from, to)));
        hn::StoreU(exp_of_minus(depth), kF, clear + i);
    }
}

HWY_ATTR void veil(const math::Vec3& color, const float* clear, uint32_t count,
                   float* const radiance[3]) {
    for (uint32_t i = 0; i < count; i += kLanes) {
        const Vf part = hn::LoadU(kF, clear + i), rest = hn::Sub(splat(1.0f), part);
        for (int k = 0; k < 3; ++k) {
            const Vf behind = hn::Mul(hn::LoadU(kF, radiance[k] + i), part);
            hn::StoreU(hn::Add(behind, hn::Mul(splat(color[k]), rest)), kF, radiance[k] + i);
        }
    }
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
