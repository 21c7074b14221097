// A kind of light: the same from everywhere, like a sun. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_DIRECTIONAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_DIRECTIONAL_INL_H
#undef PEREGRINE_SHADE_DIRECTIONAL_INL_H
#else
#define PEREGRINE_SHADE_DIRECTIONAL_INL_H
#endif

#include "shade/light/incidence-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

struct DirectionalLight {
    static constexpr bool kHasPlace = false;

    static HWY_INLINE Incidence meet(const Surface& surface, const PreparedLight& light,
                                     uint32_t i) {
        Incidence in(surface, i, splat(-light.direction));
        in.distance = splat(1.0f);
        return in;
    }

    static HWY_INLINE Vf shape(const PreparedLight&, const Incidence&, Vf weight) { return weight; }
};

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
