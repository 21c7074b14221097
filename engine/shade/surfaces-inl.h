// From hits to surfaces. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_SURFACES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_SURFACES_INL_H
#undef PEREGRINE_SHADE_SURFACES_INL_H
#else
#define PEREGRINE_SHADE_SURFACES_INL_H
#endif

#include "shade/kernels.h"
#include "shade/texels-inl.h"
#include "shade/triangle_shading.h"
#include "shade/vectors-inl.h"

// Neighbouring rays mostly hit the same triangle. Each run of them is shaded with that triangle's
// data in registers: what the scene or the triangle lacks is asked once a run, not once a pixel.
// The last vector of a run writes past its end; the next run overwrites that.
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

HWY_INLINE void fill(const math::Vec3& value, Run run, Surface::Lanes* out) {
    const V3 v = splat(value);
    for (uint32_t i = run.begin; i < run.end; i += kLanes) store(v, out, i);
}

HWY_INLINE void fill(float value, Run run, Surface::Lanes& out) {
    for (uint32_t i = run.begin; i < run.end; i += kLanes) hn::StoreU(splat(value), kF, out + i);
}

HWY_INLINE void find_geometry(const TriangleShading& triangle, const RayHits& hits, Run run,
                              Surface& out) {
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

// The interpolated normal `out.normal` bent by the normal map. On a back face the whole tangent
// frame turns round.
HWY_INLINE void map_normals(const TriangleShading& triangle, const RayHits& hits, Run run,
                            bool back_face, Surface& out) {
    const V3 geometric = splat(triangle.geometric);
    const Vf turn = splat(back_face ? -1.0f : 1.0f);
    const Vf handedness = splat(triangle.handedness);
    const Vf bump = splat(triangle.material->normal_scale);
    const Vf one = splat(1.0f), two = splat(2.0f);
    sample_texture(triangle.normal_map, hits.u, hits.v, run.begin, run.end,
                   [&](uint32_t i, const V3& texel) HWY_ATTR {
                       const Weights w = weights(hits.u, hits.v, i);
                       const V3 n = normalize(load(out.normal, i), geometric);
                       const V3 raw = flip(blend(w, triangle.tangent), turn);
                       const V3 flat = subtract(raw, scale(n, dot(raw, n)));
                       const V3 t = normalize(flat, geometric);
                       const V3 b = flip(scale(cross(n, t), handedness), turn);
                       const Vf x = hn::Mul(hn::Sub(hn::Mul(texel.x, two), one), bump);
                       const Vf y = hn::Mul(hn::Sub(hn::Mul(texel.y, two), one), bump);
                       const Vf z = hn::Sub(hn::Mul(texel.z, two), one);
                       store(add(add(scale(t, x), scale(b, y)), scale(n, z)), out.normal, i);
                   });
}

HWY_INLINE void find_colors(const TriangleShading& triangle, uint32_t features, const RayHits& hits,
                            Run run, Surface& out) {
    const scene::Material& material = *triangle.material;
    const math::Vec3 base(material.base_color);
    if (triangle.base_color.texture)
        sample_texture(triangle.base_color, hits.u, hits.v, run.begin, run.end,
                       [&](uint32_t i, const V3& texel) HWY_ATTR {
                           const V3 tint = splat(base);
                           store({hn::Mul(texel.x, tint.x), hn::Mul(texel.y, tint.y),
                                  hn::Mul(texel.z, tint.z)},
                                 out.albedo, i);
                       });
    else
        fill(base, run, out.albedo);
    if (features & scene::kSpecular) {
        fill(material.specular * triangle.highlight_gain, run, out.specular);
        fill(material.shininess, run, out.shininess);
    }
    if (!(features & scene::kEmissive)) return;
    if (triangle.emissive.texture)
        sample_texture(triangle.emissive, hits.u, hits.v, run.begin, run.end,
                       [&](uint32_t i, const V3& texel) HWY_ATTR {
                           const V3 tint = splat(material.emissive);
                           store({hn::Mul(texel.x, tint.x), hn::Mul(texel.y, tint.y),
                                  hn::Mul(texel.z, tint.z)},
                                 out.emissive, i);
                       });
    else
        fill(material.emissive, run, out.emissive);
}

HWY_INLINE void miss(uint32_t features, Run run, Surface& out) {
    const math::Vec3 zero(0);
    fill(zero, run, out.position);
    fill(zero, run, out.geometric);
    fill(zero, run, out.normal);
    fill(zero, run, out.albedo);
    if (features & scene::kEmissive) fill(zero, run, out.emissive);
    if (!(features & scene::kSpecular)) return;
    fill(zero, run, out.specular);
    fill(1.0f, run, out.shininess);
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

HWY_ATTR void find_surfaces(const scene::Snapshot& snapshot, uint32_t features,
                            const SurfaceSpace& space, const RayHits& hits, Surface& out) {
    TriangleShading triangle;
    out.run_count = 0;
    for (uint32_t begin = 0; begin < hits.count;) {
        const Run run = next_run(hits, begin);
        begin = run.end;
        out.runs[out.run_count++] = run;
        if (hits.triangle[run.begin] == geometry::kNoTriangle) {
            miss(features, run, out);
            continue;
        }
        const bool back_face = hits.back_face[run.begin] != 0;
        gather(snapshot, features, hits.triangle[run.begin], back_face, space, triangle);
        find_geometry(triangle, hits, run, out);
        if (triangle.normal_map.texture) map_normals(triangle, hits, run, back_face, out);
        find_colors(triangle, features, hits, run, out);
    }
    finish(features, hits, out);
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
