// Samples of smaller copies of a texture where rays cover many texels. Included once for each
// instruction set.
#if defined(PEREGRINE_SHADE_LEVELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_LEVELS_INL_H
#undef PEREGRINE_SHADE_LEVELS_INL_H
#else
#define PEREGRINE_SHADE_LEVELS_INL_H
#endif

#include "shade/surface/footprint-inl.h"
#include "shade/surface/texels-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

// What each ray of a vector takes from one level.
struct LevelTaps {
    HWY_ALIGN float share[HWY_LANES(float)];   // of each tap
    HWY_ALIGN int32_t count[HWY_LANES(float)]; // of taps
    HWY_ALIGN int32_t level[HWY_LANES(float)];
    TexelAddresses addresses[kMostTaps];
};

HWY_INLINE void find_taps(const scene::Texture& texture, const LevelChoice& choice, Vf u, Vf v,
                          Vi level, Vf share, LevelTaps& out) {
    const Vi one = hn::Set(kI, 1);
    const Mf taken = hn::Gt(share, hn::Zero(kF));
    hn::Store(hn::Div(share, choice.taps), kF, out.share);
    hn::Store(hn::ConvertTo(kI, hn::IfThenElseZero(taken, choice.taps)), kI, out.count);
    hn::Store(level, kI, out.level);
    const VectorLevel sizes(hn::Max(hn::Shr(hn::Set(kI, int32_t(texture.width)), level), one),
                            hn::Max(hn::Shr(hn::Set(kI, int32_t(texture.height)), level), one));
    const Vf step_u = hn::Mul(choice.step_x, splat(1.0f / float(texture.width)));
    const Vf step_v = hn::Mul(choice.step_y, splat(1.0f / float(texture.height)));
    const Vf middle = hn::Mul(hn::Sub(choice.taps, splat(1.0f)), splat(0.5f));
    for (uint32_t k = 0; k < kMostTaps; ++k) {
        const Vf number = splat(float(k));
        if (hn::AllFalse(kF, hn::And(taken, hn::Lt(number, choice.taps)))) return;
        const Vf place = hn::Sub(number, middle);
        find_texels(texture, sizes, hn::Add(u, hn::Mul(step_u, place)),
                    hn::Add(v, hn::Mul(step_v, place)), out.addresses[k]);
    }
}

// Two levels are blended in the middle third of the way from one to the next only: nobody sees
// where, and two thirds of the rays need just one.
HWY_INLINE Vf share_of_next(Vf part) {
    const Vf blend = hn::Sub(hn::Mul(part, splat(3.0f)), splat(1.0f));
    return hn::Min(hn::Max(blend, hn::Zero(kF)), splat(1.0f));
}

template <class Channel>
HWY_INLINE void fetch_taps(const scene::Texture& texture, const LevelTaps* levels, uint32_t count,
                           float* rgba) {
    const auto* texels = reinterpret_cast<const Channel*>(texture.texels.data());
    const auto sample = [&](uint32_t n, int32_t k, uint32_t j) HWY_ATTR {
        const LevelTaps& taps = levels[n];
        const Channel* const level =
            texels + size_t(texture.level_first[size_t(taps.level[j])]) * 4;
        const Texel texel = fetch_sample(level, texture.sampling, taps.addresses[k], j);
        return scale_texel(texel, taps.share[j]);
    };
    for (uint32_t j = 0; j < count; ++j) {
        // The finer level has taps unless all is of the next one.
        const uint32_t first = levels[0].count[j] > 0 ? 0 : 1;
        Texel sum = sample(first, 0, j);
        for (int32_t k = 1; k < levels[first].count[j]; ++k)
            sum = add_texel(sum, sample(first, k, j));
        if (first == 0)
            for (int32_t k = 0; k < levels[1].count[j]; ++k) sum = add_texel(sum, sample(1, k, j));
        store_texel(sum, rgba + 4 * j);
    }
}

// Of one vector of rays the first `count`.
HWY_NOINLINE HWY_ATTR void sample_levels(const scene::Texture& texture, const LevelChoice& choice,
                                         Vf u, Vf v, uint32_t count, float* rgba) {
    const Vf floor = hn::Floor(choice.level);
    const Vf next = share_of_next(hn::Sub(choice.level, floor));
    const Vi level = hn::ConvertTo(kI, floor);
    const Vi last = hn::Set(kI, int32_t(texture.level_count - 1));
    LevelTaps levels[2];
    find_taps(texture, choice, u, v, level, hn::Sub(splat(1.0f), next), levels[0]);
    find_taps(texture, choice, u, v, hn::Min(hn::Add(level, hn::Set(kI, 1)), last), next,
              levels[1]);
    if (texture.storage == scene::Texture::Storage::unorm16)
        fetch_taps<uint16_t>(texture, levels, count, rgba);
    else
        fetch_taps<float>(texture, levels, count, rgba);
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
