// Textures over the rays of a run. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_SAMPLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_SAMPLE_INL_H
#undef PEREGRINE_SHADE_SAMPLE_INL_H
#else
#define PEREGRINE_SHADE_SAMPLE_INL_H
#endif

#include "shade/surface/levels-inl.h"
#include "shade/surface/runs-inl.h"
#include "shade/surface/texels-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

// A texture on the triangle that all rays of a run hit.
struct SampledTexture {
    const scene::Texture& texture;
    const TextureOnTriangle& placed;
    const RayHits& hits;
    Run run;

    HWY_INLINE void coordinates(uint32_t i, Vf& u, Vf& v) const {
        const Weights w = weights(hits.u, hits.v, i);
        u = blend(w, placed.uv[0].x, placed.uv[1].x, placed.uv[2].x);
        v = blend(w, placed.uv[0].y, placed.uv[1].y, placed.uv[2].y);
    }

    HWY_INLINE uint32_t count(uint32_t i) const { return std::min(run.end - i, kLanes); }

    HWY_INLINE void fetch(const TexelAddresses& addresses, uint32_t i, float* rgba) const {
        if (texture.storage == scene::Texture::Storage::unorm16)
            fetch_samples<uint16_t>(texture, addresses, count(i), rgba);
        else
            fetch_samples<float>(texture, addresses, count(i), rgba);
    }
};

template <class Use>
HWY_INLINE void hand_on(const float* rgba, Vf scale_by, uint32_t i, Use&& use) {
    Vf r, g, b, a;
    hn::LoadInterleaved4(kF, rgba, r, g, b, a);
    use(i, scale(V3{r, g, b}, scale_by));
}

// Texels seldom are in the cache: each vector's are asked for while the previous one is filtered.
template <class Use>
HWY_INLINE void sample_finest(const SampledTexture& sampled, Use&& use) {
    const scene::Texture& texture = sampled.texture;
    const Run run = sampled.run;
    const Vf scale_by = splat(scene::texel_scale(texture));
    TexelAddresses addresses[2];
    HWY_ALIGN float rgba[4 * HWY_LANES(float)];
    for (uint32_t k = 0; k < 4; ++k) hn::Store(hn::Zero(kF), kF, rgba + k * kLanes);
    const auto address = [&](uint32_t i, TexelAddresses& out) HWY_ATTR {
        Vf u, v;
        sampled.coordinates(i, u, v);
        find_texels(texture, finest_level(texture), u, v, out);
        prefetch_texels(texture, out);
    };
    address(run.begin, addresses[0]);
    uint32_t current = 0;
    for (uint32_t i = run.begin; i < run.end; i += kLanes, current ^= 1) {
        if (i + kLanes < run.end) address(i + kLanes, addresses[current ^ 1]);
        sampled.fetch(addresses[current], i, rgba);
        hand_on(rgba, scale_by, i, use);
    }
}

template <class Use>
HWY_INLINE void sample_by_footprint(const TriangleShading& triangle, const SampledTexture& sampled,
                                    Use&& use) {
    const scene::Texture& texture = sampled.texture;
    const math::Vec2* const uv = sampled.placed.uv;
    const math::Vec2 size(float(texture.width), float(texture.height));
    const math::Vec2 side1 = (uv[1] - uv[0]) * size, side2 = (uv[2] - uv[0]) * size;
    const BarycentricGradients gradients(triangle);
    const Vf scale_by = splat(scene::texel_scale(texture));
    TexelAddresses addresses{};
    HWY_ALIGN float rgba[4 * HWY_LANES(float)] = {};
    for (uint32_t i = sampled.run.begin; i < sampled.run.end; i += kLanes) {
        Vf u, v;
        sampled.coordinates(i, u, v);
        const Ellipse covered =
            on_texture(footprint(gradients, triangle.geometric, sampled.hits, i), side1, side2);
        const uint32_t count = sampled.count(i);
        if (all_are_small(covered, hn::FirstN(kF, count))) {
            find_texels(texture, finest_level(texture), u, v, addresses);
            sampled.fetch(addresses, i, rgba);
        } else {
            const LevelChoice choice = choose_level(covered, float(texture.level_count - 1));
            sample_levels(texture, choice, u, v, count, rgba);
        }
        hand_on(rgba, scale_by, i, use);
    }
}

// Calls use(i, colour) for each vector i of the run's rays.
template <class Use>
HWY_INLINE void sample_texture(const TriangleShading& triangle, const TextureOnTriangle& placed,
                               const RayHits& hits, Run run, Use&& use) {
    const SampledTexture sampled{*placed.texture, placed, hits, run};
    if (hits.footprint > 0 && placed.texture->level_count > 1)
        sample_by_footprint(triangle, sampled, use);
    else
        sample_finest(sampled, use);
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
