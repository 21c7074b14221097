// Where hits are, and their normals. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_GEOMETRY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_GEOMETRY_INL_H
#undef PEREGRINE_SHADE_GEOMETRY_INL_H
#else
#define PEREGRINE_SHADE_GEOMETRY_INL_H
#endif

#include "shade/surface/runs-inl.h"
#include "shade/surface/sample-inl.h"
#include "shade/surface/triangle_shading.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

HWY_INLINE void find_geometry(const TriangleShading& triangle, uint32_t features,
                              const RayHits& hits, Run run, Surface& out) {
    if (features & scene::kSpecular) fill(triangle.look.material->shininess, run, out.shininess);
    const V3 geometric = splat(triangle.geometric);
    const V3 lift = splat(triangle.lift);
    for (uint32_t i = run.begin; i < run.end; i += kLanes) {
        const Weights w = weights(hits.u, hits.v, i);
        store(add(blend(w, triangle.vertex), lift), out.position, i);
        store(geometric, out.geometric, i);
        if (!triangle.smooth) {
            store(geometric, out.normal, i);
            continue;
        }
        const V3 normal = blend(w, triangle.normal);
        store(flip(normal, dot(normal, geometric)), out.normal, i);
    }
}

// What normal maps are relative to. On a back face the whole tangent frame turns round.
HWY_INLINE void find_tangents(const TriangleShading& triangle, const RayHits& hits, Run run,
                              bool back_face, Surface& out) {
    const Vf turn = splat(back_face ? -1.0f : 1.0f);
    for (uint32_t i = run.begin; i < run.end; i += kLanes)
        store(flip(blend(weights(hits.u, hits.v, i), triangle.tangent), turn), out.tangent, i);
    fill(back_face ? -triangle.handedness : triangle.handedness, run, out.side);
}

// The interpolated normal `out.normal` bent by the normal map.
HWY_INLINE void map_normals(const MaterialLook& look, bool by_footprint, Run span, Surface& out) {
    const Vf bump = splat(look.material->normal_scale);
    const Vf one = splat(1.0f), two = splat(2.0f);
    sample_texture(look.normal, out, by_footprint, span,
                   [&](uint32_t i, const V3& texel, Vf) HWY_ATTR {
                       const V3 geometric = load(out.geometric, i);
                       const V3 n = normalize(load(out.normal, i), geometric);
                       const V3 raw = load(out.tangent, i);
                       const V3 t = normalize(subtract(raw, scale(n, dot(raw, n))), geometric);
                       const V3 b = flip(cross(n, t), hn::LoadU(kF, out.side + i));
                       const Vf x = hn::Mul(hn::Sub(hn::Mul(texel.x, two), one), bump);
                       const Vf y = hn::Mul(hn::Sub(hn::Mul(texel.y, two), one), bump);
                       const Vf z = hn::Sub(hn::Mul(texel.z, two), one);
                       store(add(add(scale(t, x), scale(b, y)), scale(n, z)), out.normal, i);
                   });
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
