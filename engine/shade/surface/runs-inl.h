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

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using Run = TriangleRun;

// Arrays are readable beyond their end.
HWY_INLINE Run next_run(const RayHits& hits, uint32_t begin) {
    const Vu triangle = hn::Set(kU, hits.triangle[begin]);
    const Vu back_face = hn::Set(kU, hits.back_face[begin]);
    const bool missed = hits.triangle[begin] == geometry::kNoTriangle;
    for (uint32_t i = begin;; i += kLanes) {
        auto differs = hn::Ne(hn::LoadU(kU, hits.triangle + i), triangle);
        if (!missed)
            differs = hn::Or(differs, hn::Ne(hn::LoadU(kU, hits.back_face + i), back_face));
        const intptr_t first = hn::FindFirstTrue(kU, differs);
        if (first >= 0) return {begin, std::min(i + uint32_t(first), hits.count)};
        if (i + kLanes >= hits.count) return {begin, hits.count};
    }
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
