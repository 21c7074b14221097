// A material program: what reflects the same in all directions. Included once for each instruction
// set.
#if defined(PEREGRINE_SHADE_MATT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_MATT_INL_H
#undef PEREGRINE_SHADE_MATT_INL_H
#else
#define PEREGRINE_SHADE_MATT_INL_H
#endif

#include "shade/light/illumination.h"
#include "shade/surface/surface.h"
#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

struct Matt {
    static constexpr bool kHasLobe = false;

    // `in`: what the diffuse surface gets, over pi.
    static HWY_INLINE V3 reflect(const Surface& surface, const Illumination&, const V3& in,
                                 uint32_t i) {
        return multiply(load(surface.albedo, i), in);
    }
};

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
