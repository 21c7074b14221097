// Neighbouring rays that hit one triangle. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_RUNS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_RUNS_INL_H
#undef PEREGRINE_SHADE_RUNS_INL_H
#else
#define PEREGRINE_SHADE_RUNS_INL_H
#endif

#include "geometry/triangle.h"
#include "shade/surface/ray_hits.h"
#include "shade/surface/surface.h"
#include "shade/surface/weights-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using Run = TriangleRun;

HWY_INLINE Run next_run(const RayHits& hits, uint32_t begin) {
    const uint32_t triangle = hits.triangle[begin], back_face = hits.back_face[begin];
    uint32_t end = begin + 1;
    while (end < hits.count && hits.triangle[end] == triangle
           && (hits.back_face[end] == back_face || triangle == geometry::kNoTriangle))
        ++end;
    return {begin, end};
}

// The last vector of a run writes past its end; the next run overwrites that.
HWY_INLINE void fill(const math::Vec3& value, Run run, Surface::Lanes* out) {
    const V3 v = splat(value);
    for (uint32_t i = run.begin; i < run.end; i += kLanes) store(v, out, i);
}

HWY_INLINE void fill(float value, Run run, Surface::Lanes& out) {
    for (uint32_t i = run.begin; i < run.end; i += kLanes) hn::StoreU(splat(value), kF, out + i);
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
