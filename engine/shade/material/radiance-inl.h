// From light to radiance. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_RADIANCE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_RADIANCE_INL_H
#undef PEREGRINE_SHADE_RADIANCE_INL_H
#else
#define PEREGRINE_SHADE_RADIANCE_INL_H
#endif

#include "geometry/triangle.h"
#include "scene/light.h"
#include "shade/light/illumination.h"
#include "shade/surface/ray_hits.h"
#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Arauna's model of shading (Bikker 2007, section 2): ambient + diffuse + specular + emissive.
template <class Program, Surroundings From, bool Emissive>
HWY_ATTR void find_radiance(const Surface& surface, const Illumination& light, const RayHits& hits,
                            const scene::Environment& environment, float* const radiance[3]) {
    const Vf inverse_pi = splat(0.31830988618f);
    const V3 ambient = splat(environment.ambient), background = splat(environment.background);
    for (uint32_t i = 0; i < hits.count; i += kLanes) {
        V3 around = ambient;
        if constexpr (From != Surroundings::even)
            around = scale(ambient, hn::LoadU(kF, light.openness + i));
        if constexpr (From == Surroundings::bright) around = add(around, load(light.bounced, i));
        const V3 in = add(around, scale(load(light.irradiance, i), inverse_pi));
        V3 out = Program::reflect(surface, light, in, i);
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
