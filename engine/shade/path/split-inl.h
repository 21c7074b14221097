// What goes on from hits: mirrored light, and light that comes through. Included once for each
// instruction set.
#if defined(PEREGRINE_SHADE_SPLIT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_SPLIT_INL_H
#undef PEREGRINE_SHADE_SPLIT_INL_H
#else
#define PEREGRINE_SHADE_SPLIT_INL_H
#endif

#include "shade/path/fresnel-inl.h"
#include "shade/path/path_rays.h"
#include "shade/surface/runs-inl.h"
#include "shade/surface/sample-inl.h"
#include "shade/surface/triangle_shading.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

// Of the last vector of a run only its own rays.
HWY_INLINE void store_some(Mf mask, const V3& v, Surface::Lanes* lanes, uint32_t i) {
    store(select(mask, v, load(lanes, i)), lanes, i);
}

// Fills what the sides of the hull of a solid have beside them, ray by ray.
HWY_INLINE void cross_hull(const scene::MaterialSet& set, uint32_t solid, bool leaves, Run run,
                           const Media* media, SplitRays& out) {
    const auto index = [&](uint32_t material) {
        return material == Media::kNone ? 1.0f : set.materials[material].index_of_refraction;
    };
    for (uint32_t i = run.begin; i < run.end; ++i) {
        Media here = media[i];
        if (leaves && !here.holds(solid)) here.enter(solid); // its hull is open somewhere
        Media beyond = here;
        if (leaves)
            beyond.leave(solid);
        else
            beyond.enter(solid);
        out.mirrored.media[i] = here;
        out.through.media[i] = beyond;
        out.eta[i] = index(here.innermost()) / index(beyond.innermost());
    }
}

HWY_INLINE void find_cover(const scene::Material& material, uint32_t features, bool by_footprint,
                           Run run, const Surface& surface, SplitRays& out) {
    const Vf alpha = splat(material.base_color.a), one = splat(1.0f);
    MaterialLook look;
    look.look_at(material, features & scene::kTextures);
    if (!look.color.texture) return fill(std::min(material.base_color.a, 1.0f), run, out.cover);
    // The colour's coordinates are the first of a look at all textures, too.
    sample_texture(look.color, surface, by_footprint, run,
                   [&](uint32_t i, const V3&, Vf texel) HWY_ATTR {
                       hn::StoreU(hn::Min(hn::Mul(texel, alpha), one), kF, out.cover + i);
                   });
}

// How a material splits what comes from it.
struct Split {
    const scene::Material& material;
    bool from_within; // the ray meets the hull of a solid from its inside
    bool is_lit;      // something of it shows the light of lamps

    HWY_INLINE Split(const scene::Material& material_, bool back_face)
        : material(material_), from_within(material_.is_solid() && back_face) {
        const bool is_matt =
            material.transmission < 1 && math::Vec3(material.base_color) != math::Vec3(0);
        const bool shines =
            material.specular != math::Vec3(0) || material.roughness_texture.texture;
        is_lit = is_matt || (shines && !from_within);
    }

    // The rays of one vector, `mask` of them.
    HWY_INLINE void run(uint32_t features, const RayHits& hits, uint32_t i, Mf mask,
                        Surface& surface, SplitRays& out) const {
        const V3 along{hn::LoadU(kF, hits.direction[0] + i), hn::LoadU(kF, hits.direction[1] + i),
                       hn::LoadU(kF, hits.direction[2] + i)};
        const View view(along, load(surface.normal, i), load(surface.geometric, i));
        const V3 one = splat(math::Vec3(1));
        V3 mirrored = splat(math::Vec3(0));
        if (material.reflectivity > 0)
            mirrored =
                schlick(splat(material.reflection_color * material.reflectivity), view.cosine);
        V3 through = splat(math::Vec3(0)), matt = subtract(one, mirrored);
        const V3 albedo = load(surface.albedo, i);
        if (material.transmission > 0) {
            const Vf eta = material.thin ? splat(1.0f / material.index_of_refraction)
                                         : hn::LoadU(kF, out.eta + i);
            const Refraction bent(view.cosine, eta);
            const Vf reflectance =
                material.thin ? of_both_sides(bent.reflectance) : bent.reflectance;
            mirrored = add(mirrored, scale(matt, reflectance));
            matt = subtract(one, mirrored);
            const V3 tint{hn::Min(albedo.x, one.x), hn::Min(albedo.y, one.y),
                          hn::Min(albedo.z, one.z)};
            through = scale(multiply(matt, tint), splat(material.transmission));
            matt = scale(matt, splat(1.0f - material.transmission));
            const V3 onward = material.thin ? along : view.bent(eta, bent);
            store_some(mask, onward, out.through.direction, i);
        }
        if (material.is_translucent()) {
            const Vf cover = hn::LoadU(kF, out.cover + i);
            mirrored = scale(mirrored, cover);
            matt = scale(matt, cover);
            const V3 seen = scale(one, hn::Sub(one.x, cover));
            through = add(scale(through, cover), seen);
            store_some(mask, along, out.through.direction, i);
            uncover(features, i, mask, cover, surface);
        }
        store_some(mask, through, out.through.weight, i);
        store_some(mask, view.mirrored(), out.mirrored.direction, i);
        store_some(mask, mirrored, out.mirrored.weight, i);
        store_some(mask, load(surface.position, i), out.mirrored.origin, i);
        store_some(mask, multiply(albedo, matt), surface.albedo, i);
        darken(features, i, mask, surface);
    }

private:
    // What the surface itself sends out, where it is.
    HWY_INLINE void uncover(uint32_t features, uint32_t i, Mf mask, Vf cover,
                            Surface& surface) const {
        if (features & scene::kSpecular)
            store_some(mask, scale(load(surface.specular, i), cover), surface.specular, i);
        if (features & scene::kEmissive)
            store_some(mask, scale(load(surface.emissive, i), cover), surface.emissive, i);
    }

    // No lamp shines on what does not show it, nor makes a highlight inside of a solid.
    HWY_INLINE void darken(uint32_t features, uint32_t i, Mf mask, Surface& surface) const {
        const V3 zero = splat(math::Vec3(0));
        if ((features & scene::kSpecular) && from_within)
            store_some(mask, zero, surface.specular, i);
        if (is_lit) return;
        store_some(mask, zero, surface.normal, i);
        store_some(mask, zero, surface.geometric, i);
    }
};

// Where rays begin that go through: as surface.position, on the far side.
HWY_INLINE void find_far_side(const TriangleShading& triangle, const RayHits& hits, uint32_t i,
                              Mf mask, SplitRays& out) {
    const V3 place = blend(weights(hits.u, hits.v, i), triangle.vertex);
    store_some(mask, subtract(place, splat(triangle.lift)), out.through.origin, i);
}

// What is behind a translucent surface that a program of the host shades: the rest of it is the
// program's.
HWY_INLINE void see_through(const RayHits& hits, uint32_t i, Mf mask, SplitRays& out) {
    const Vf behind = hn::Sub(splat(1.0f), hn::LoadU(kF, out.cover + i));
    store_some(mask, {behind, behind, behind}, out.through.weight, i);
    store_some(mask,
               {hn::LoadU(kF, hits.direction[0] + i), hn::LoadU(kF, hits.direction[1] + i),
                hn::LoadU(kF, hits.direction[2] + i)},
               out.through.direction, i);
}

// Takes from the surfaces what the rays that go on will bring. `media`: of the rays that arrive.
// Programmed: some may have a program of the host.
template <bool Programmed>
HWY_ATTR void split_paths(const scene::Snapshot& snapshot, uint32_t features,
                          const SurfaceSpace& space, const RayHits& hits, const Media* media,
                          Surface& surface, SplitRays& out) {
    out.any = false;
    TriangleShading triangle;
    for (uint32_t r = 0; r < surface.run_count; ++r) {
        const Run run = surface.runs[r];
        const uint32_t hit = hits.triangle[run.begin];
        if (hit == geometry::kNoTriangle) continue;
        const geometry::TriangleInfo info = trace::info(snapshot.world, hit);
        const scene::Snapshot::Mesh& mesh = snapshot.meshes[info.mesh];
        const uint32_t number = mesh.materials->of(info.primitive);
        const scene::Material& material = snapshot.material_set->materials[number];
        if (!material.sends_paths_on()) continue;
        if (!out.any) out.clear();
        const bool back_face = hits.back_face[run.begin] != 0;
        if (material.is_solid()) {
            cross_hull(*snapshot.material_set, number, back_face, run, media, out);
        } else {
            std::copy(media + run.begin, media + run.end, out.mirrored.media + run.begin);
            std::copy(media + run.begin, media + run.end, out.through.media + run.begin);
        }
        const bool goes_through = material.may_pass_light();
        if (goes_through) gather(snapshot, 0, hit, back_face, space, triangle);
        if (material.is_translucent())
            find_cover(material, features, hits.footprint > 0, run, surface, out);
        const Split split(material, back_face);
        for (uint32_t i = run.begin; i < run.end; i += kLanes) {
            const Mf mask = hn::FirstN(kF, run.end - i);
            if (Programmed && material.program != 0)
                see_through(hits, i, mask, out);
            else
                split.run(features, hits, i, mask, surface, out);
            if (goes_through) find_far_side(triangle, hits, i, mask, out);
        }
    }
}

// Beer's law over the first t of each ray's direction; absorption per metre.
HWY_ATTR void absorb(const float* const direction[3], const float* t, uint32_t count,
                     const Surface::Lanes* absorption, Surface::Lanes* weight) {
    for (uint32_t i = 0; i < count; i += kLanes) {
        const V3 d{hn::LoadU(kF, direction[0] + i), hn::LoadU(kF, direction[1] + i),
                   hn::LoadU(kF, direction[2] + i)};
        const Vf metres = hn::Min(hn::Mul(hn::LoadU(kF, t + i), hn::Sqrt(dot(d, d))), splat(1e30f));
        const V3 per_metre = load(absorption, i);
        store(multiply(load(weight, i), {exp_of_minus(hn::Mul(per_metre.x, metres)),
                                         exp_of_minus(hn::Mul(per_metre.y, metres)),
                                         exp_of_minus(hn::Mul(per_metre.z, metres))}),
              weight, i);
    }
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
