// A kind of light: one that shines from a point, all around. Included once for each instruction
// set.
#if defined(PEREGRINE_SHADE_POINT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_POINT_INL_H
#undef PEREGRINE_SHADE_POINT_INL_H
#else
#define PEREGRINE_SHADE_POINT_INL_H
#endif

#include "shade/light/incidence-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

struct PointLight {
    static constexpr bool kHasPlace = true;

    static HWY_INLINE Incidence meet(const Surface& surface, const PreparedLight& light,
                                     uint32_t i) {
        Incidence in(surface, i, subtract(splat(light.position), load(surface.position, i)));
        in.measure(light);
        return in;
    }

    // The light that goes this way, in parts of its intensity.
    static HWY_INLINE Vf shape(const PreparedLight&, const Incidence&, Vf weight) { return weight; }
};

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
