// How light comes in at points. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_INCIDENCE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_INCIDENCE_INL_H
#undef PEREGRINE_SHADE_INCIDENCE_INL_H
#else
#define PEREGRINE_SHADE_INCIDENCE_INL_H
#endif

#include "scene/lights/prepared_light.h"
#include "shade/surface/surface.h"
#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// What a light does at a point, before visibility. Lengths are in units of |to_light|.
struct Incidence {
    V3 to_light;  // not normalised: shadow rays reach from t = 0 to 1
    Vf distance;  // |to_light|
    Vf cosine;    // normal . to_light
    Vf geometric; // the same with the geometric normal
    Mf lit;

    HWY_INLINE Incidence(const Surface& surface, uint32_t i, const V3& to_light_)
        : to_light(to_light_), cosine(dot(load(surface.normal, i), to_light)),
          geometric(dot(load(surface.geometric, i), to_light)),
          lit(hn::And(hn::Gt(cosine, hn::Zero(kF)), hn::Gt(geometric, hn::Zero(kF)))) {}

    // Of a light that has a place.
    HWY_INLINE void measure(const PreparedLight& light) {
        distance = hn::Sqrt(dot(to_light, to_light));
        lit = hn::And(lit, hn::Lt(distance, splat(light.radius)));
    }
};

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
