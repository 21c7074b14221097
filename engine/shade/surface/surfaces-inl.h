// From hits to surfaces. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_SURFACES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_SURFACES_INL_H
#undef PEREGRINE_SHADE_SURFACES_INL_H
#else
#define PEREGRINE_SHADE_SURFACES_INL_H
#endif

#include "shade/surface/colors-inl.h"
#include "shade/surface/coordinates-inl.h"
#include "shade/surface/geometry-inl.h"
#include "shade/surface/runs-inl.h"
#include "shade/surface/wear-inl.h"

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
    if (features & scene::kOcclusionTextures) fill(1.0f, run, out.occlusion);
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

// Rays along Morton's curve come back to triangles that they left a few runs ago.
class RecentTriangles {
public:
    HWY_INLINE const TriangleShading& find(const scene::Snapshot& snapshot, uint32_t features,
                                           const SurfaceSpace& space, uint32_t triangle,
                                           bool back_face) {
        const uint32_t place = triangle % kCount;
        const uint64_t name = uint64_t(triangle) << 1 | uint64_t(back_face);
        if (names_[place] != name) {
            gather(snapshot, features, triangle, back_face, space, triangles_[place]);
            names_[place] = name;
        }
        return triangles_[place];
    }

private:
    static constexpr uint32_t kCount = 8;
    static constexpr uint64_t kNone = ~uint64_t(0);

    uint64_t names_[kCount] = {kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};
    TriangleShading triangles_[kCount];
};

// What follows from the material alone, for neighbouring rays that see one.
template <SurfacePart Part>
HWY_INLINE void finish_span(const MaterialLook& look, uint32_t features, const RayHits& hits,
                            Run span, Surface& out) {
    const bool by_footprint = hits.footprint > 0;
    if constexpr (Part != SurfacePart::colors)
        if (look.normal.texture) map_normals(look, by_footprint, span, out);
    if constexpr (Part != SurfacePart::geometry)
        find_colors(look, features, by_footprint, span, out);
    if (look.roughness.texture) find_roughness<Part>(look, features, by_footprint, span, out);
    if constexpr (Part != SurfacePart::geometry)
        if ((features & scene::kOcclusionTextures) && !has_both(look))
            find_occlusion(look, by_footprint, span, out);
}

// Neighbouring rays mostly hit the same triangle, and yet more often see the same material. A
// triangle's data stay in registers for each run of rays that hit it, which only blends them;
// textures are sampled, and normals bent, for spans of runs, in full vectors also where triangles
// are small. What the scene or the material lacks is asked once a run or span.
template <SurfacePart Part>
HWY_ATTR void find_surfaces(const scene::Snapshot& snapshot, uint32_t features,
                            const SurfaceSpace& space, const RayHits& hits, Surface& out) {
    RecentTriangles recent;
    MaterialLook look; // of the span that is not finished, if it has a material
    uint32_t first = 0;
    const auto finish_until = [&](uint32_t end) HWY_ATTR {
        if (look.material) finish_span<Part>(look, features, hits, {first, end}, out);
        look.material = nullptr;
        first = end;
    };
    out.run_count = 0;
    for (uint32_t begin = 0; begin < hits.count;) {
        const Run run = next_run(hits, begin);
        begin = run.end;
        out.runs[out.run_count++] = run;
        if (hits.triangle[run.begin] == geometry::kNoTriangle) {
            finish_until(run.begin);
            miss<Part>(features, run, out);
            continue;
        }
        const bool back_face = hits.back_face[run.begin] != 0;
        const TriangleShading& triangle =
            recent.find(snapshot, features, space, hits.triangle[run.begin], back_face);
        if (triangle.look.material != look.material) {
            finish_until(run.begin);
            look = triangle.look;
        }
        if constexpr (Part != SurfacePart::colors) {
            find_geometry(triangle, features, hits, run, out);
            out.runs[out.run_count - 1].relief = look.material->normal_texture.texture;
            if (look.normal.texture) find_tangents(triangle, hits, run, back_face, out);
        }
        find_coordinates(triangle, hits, run, out);
    }
    finish_until(hits.count);
    if constexpr (Part != SurfacePart::colors) finish(features, hits, out);
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
