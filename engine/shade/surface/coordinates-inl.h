// Where textures lie under the rays of a run. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_COORDINATES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_COORDINATES_INL_H
#undef PEREGRINE_SHADE_COORDINATES_INL_H
#else
#define PEREGRINE_SHADE_COORDINATES_INL_H
#endif

#include "shade/surface/footprint-inl.h"
#include "shade/surface/runs-inl.h"
#include "shade/surface/surface.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

HWY_INLINE void find_coordinates(const TriangleShading& triangle, const RayHits& hits, Run run,
                                 Surface& out) {
    for (uint32_t k = 0; k < triangle.look.place_count; ++k) {
        const math::Vec2* const at = triangle.texcoord[k];
        for (uint32_t i = run.begin; i < run.end; i += kLanes) {
            const Weights w = weights(hits.u, hits.v, i);
            hn::StoreU(blend(w, at[0].x, at[1].x, at[2].x), kF, out.places[k].u + i);
            hn::StoreU(blend(w, at[0].y, at[1].y, at[2].y), kF, out.places[k].v + i);
        }
    }
    if (!(hits.footprint > 0) || triangle.look.place_count == 0) return;
    const BarycentricGradients gradients(triangle);
    for (uint32_t i = run.begin; i < run.end; i += kLanes) {
        const Ellipse covered = footprint(gradients, triangle.geometric, hits, i);
        for (uint32_t k = 0; k < triangle.look.place_count; ++k) {
            const math::Vec2* const at = triangle.texcoord[k];
            const Ellipse e = in_coordinates(covered, at[1] - at[0], at[2] - at[0]);
            hn::StoreU(e.xx, kF, out.places[k].uu + i);
            hn::StoreU(e.xy, kF, out.places[k].uv + i);
            hn::StoreU(e.yy, kF, out.places[k].vv + i);
        }
    }
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
