// Textures under the rays of a span. Included once for each instruction set.
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

// A texture under the rays of a span.
struct SampledTexture {
    const scene::Texture& texture;
    const Surface::Place& at;
    Run span;

    HWY_INLINE void find(uint32_t i, TexelAddresses& out) const {
        find_texels(texture, finest_level(texture), hn::LoadU(kF, at.u + i),
                    hn::LoadU(kF, at.v + i), out);
    }

    HWY_INLINE uint32_t count(uint32_t i) const { return std::min(span.end - i, kLanes); }

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
    use(i, scale(V3{r, g, b}, scale_by), hn::Mul(a, scale_by));
}

// Each vector's texels are asked for while the previous one is filtered.
template <class Use>
HWY_INLINE void sample_finest(const SampledTexture& sampled, Use&& use) {
    const Run span = sampled.span;
    const Vf scale_by = splat(scene::texel_scale(sampled.texture));
    TexelAddresses addresses[2];
    HWY_ALIGN float rgba[4 * HWY_LANES(float)] = {};
    const auto address = [&](uint32_t i, TexelAddresses& out) HWY_ATTR {
        sampled.find(i, out);
        prefetch_texels(sampled.texture, out);
    };
    address(span.begin, addresses[0]);
    uint32_t current = 0;
    for (uint32_t i = span.begin; i < span.end; i += kLanes, current ^= 1) {
        if (i + kLanes < span.end) address(i + kLanes, addresses[current ^ 1]);
        sampled.fetch(addresses[current], i, rgba);
        hand_on(rgba, scale_by, i, use);
    }
}

HWY_NOINLINE HWY_ATTR void find_samples(const SampledTexture& sampled, uint32_t i,
                                        LevelSamples& out) {
    const scene::Texture& texture = sampled.texture;
    const Surface::Place& at = sampled.at;
    const auto width = float(texture.width), height = float(texture.height);
    const Ellipse covered{hn::Mul(hn::LoadU(kF, at.uu + i), splat(width * width)),
                          hn::Mul(hn::LoadU(kF, at.uv + i), splat(width * height)),
                          hn::Mul(hn::LoadU(kF, at.vv + i), splat(height * height))};
    const uint32_t count = sampled.count(i);
    const LevelChoice choice = all_are_small(covered, hn::FirstN(kF, count))
                                   ? finest_choice()
                                   : choose_level(covered, float(texture.level_count - 1));
    out.find(texture, choice, hn::LoadU(kF, at.u + i), hn::LoadU(kF, at.v + i), count);
}

template <class Channel, class Use>
HWY_INLINE void sample_by_footprint(const SampledTexture& sampled, Use&& use) {
    const Run span = sampled.span;
    const Vf scale_by = splat(scene::texel_scale(sampled.texture));
    LevelSamples samples[2];
    HWY_ALIGN float rgba[4 * HWY_LANES(float)];
    find_samples(sampled, span.begin, samples[0]);
    uint32_t current = 0;
    for (uint32_t i = span.begin; i < span.end; i += kLanes, current ^= 1) {
        if (i + kLanes < span.end) find_samples(sampled, i + kLanes, samples[current ^ 1]);
        samples[current].template fetch<Channel>(sampled.texture, rgba);
        hand_on(rgba, scale_by, i, use);
    }
}

// Calls use(i, colour, alpha) for each vector i of the span's rays.
template <class Use>
HWY_INLINE void sample_texture(const MaterialLook::Sampled& sampled, const Surface& surface,
                               bool by_footprint, Run span, Use&& use) {
    const SampledTexture texture{*sampled.texture, surface.places[sampled.place], span};
    if (!by_footprint || sampled.texture->level_count == 1)
        sample_finest(texture, use);
    else if (sampled.texture->storage == scene::Texture::Storage::unorm16)
        sample_by_footprint<uint16_t>(texture, use);
    else
        sample_by_footprint<float>(texture, use);
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
