// From hits to surfaces. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_SURFACES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_SURFACES_INL_H
#undef PEREGRINE_SHADE_SURFACES_INL_H
#else
#define PEREGRINE_SHADE_SURFACES_INL_H
#endif

#include "shade/surface/colors-inl.h"
#include "shade/surface/geometry-inl.h"
#include "shade/surface/runs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

template <SurfacePart Part>
HWY_INLINE void miss(uint32_t features, Run run, Surface& out) {
    const math::Vec3 zero(0);
    if constexpr (Part != SurfacePart::colors) {
        fill(zero, run, out.position);
        fill(zero, run, out.geometric);
        fill(zero, run, out.normal);
        if (features & scene::kSpecular) fill(1.0f, run, out.shininess);
    }
    if constexpr (Part == SurfacePart::geometry) return;
    fill(zero, run, out.albedo);
    if (features & scene::kEmissive) fill(zero, run, out.emissive);
    if (features & scene::kSpecular) fill(zero, run, out.specular);
}

// What is the same for all rays: unit normals, and what follows from them.
HWY_INLINE void finish(uint32_t features, const RayHits& hits, Surface& out) {
    const Vf infinity = splat(std::numeric_limits<float>::infinity());
    V3 lower{infinity, infinity, infinity};
    V3 upper{hn::Neg(infinity), hn::Neg(infinity), hn::Neg(infinity)};
    for (uint32_t i = 0; i < hits.count; i += kLanes) {
        const auto hit = hn::And(hn::RebindMask(kF, hn::Ne(hn::LoadU(kU, hits.triangle + i),
                                                           hn::Set(kU, geometry::kNoTriangle))),
                                 hn::FirstN(kF, hits.count - i));
        const V3 p = load(out.position, i);
        lower = select(hit, {hn::Min(lower.x, p.x), hn::Min(lower.y, p.y), hn::Min(lower.z, p.z)},
                       lower);
        upper = select(hit, {hn::Max(upper.x, p.x), hn::Max(upper.y, p.y), hn::Max(upper.z, p.z)},
                       upper);
        const V3 zero{hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)};
        const V3 g = select(hit, load(out.geometric, i), zero);
        const V3 n = select(hit, normalize(load(out.normal, i), g), zero);
        store(g, out.geometric, i);
        store(n, out.normal, i);
        hn::StoreU(hn::Div(splat(1.0f), hn::Max(dot(g, n), splat(0.05f))), kF, out.bend + i);
        if (!(features & scene::kSpecular)) continue;
        const V3 d{hn::LoadU(kF, hits.direction[0] + i), hn::LoadU(kF, hits.direction[1] + i),
                   hn::LoadU(kF, hits.direction[2] + i)};
        const V3 mirrored = subtract(d, scale(n, hn::Mul(splat(2.0f), dot(d, n))));
        store(normalize(mirrored, n), out.mirror, i);
    }
    out.bounds.lower = {hn::GetLane(hn::MinOfLanes(kF, lower.x)),
                        hn::GetLane(hn::MinOfLanes(kF, lower.y)),
                        hn::GetLane(hn::MinOfLanes(kF, lower.z))};
    out.bounds.upper = {hn::GetLane(hn::MaxOfLanes(kF, upper.x)),
                        hn::GetLane(hn::MaxOfLanes(kF, upper.y)),
                        hn::GetLane(hn::MaxOfLanes(kF, upper.z))};
}

// Neighbouring rays mostly hit the same triangle. Each run of them is shaded with that triangle's
// data in registers: what the scene or the triangle lacks is asked once a run, not once a pixel.
template <SurfacePart Part>
HWY_ATTR void find_surfaces(const scene::Snapshot& snapshot, uint32_t features,
                            const SurfaceSpace& space, const RayHits& hits, Surface& out) {
    TriangleShading triangle;
    out.run_count = 0;
    for (uint32_t begin = 0; begin < hits.count;) {
        const Run run = next_run(hits, begin);
        begin = run.end;
        out.runs[out.run_count++] = run;
        if (hits.triangle[run.begin] == geometry::kNoTriangle) {
            miss<Part>(features, run, out);
            continue;
        }
        const bool back_face = hits.back_face[run.begin] != 0;
        gather(snapshot, features, hits.triangle[run.begin], back_face, space, triangle);
        if constexpr (Part != SurfacePart::colors) {
            find_geometry(triangle, features, hits, run, out);
            if (triangle.normal_map.texture) map_normals(triangle, hits, run, back_face, out);
            out.runs[out.run_count - 1].relief = triangle.material->normal_texture.texture;
        }
        if constexpr (Part != SurfacePart::geometry)
            find_colors(triangle, features, hits, run, out);
    }
    if constexpr (Part != SurfacePart::colors) finish(features, hits, out);
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
