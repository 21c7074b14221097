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

// Two levels are blended in the middle third of the way from one to the next only: nobody sees
// where, and two thirds of the rays need just one.
HWY_INLINE Vf share_of_next(Vf part) {
    const Vf blend = hn::Sub(hn::Mul(part, splat(3.0f)), splat(1.0f));
    return hn::Min(hn::Max(blend, hn::Zero(kF)), splat(1.0f));
}

HWY_INLINE VectorLevel level_of(const scene::Texture& texture, Vi level) {
    const Vi one = hn::Set(kI, 1);
    const auto* const first = reinterpret_cast<const int32_t*>(texture.level_first.data());
    return {hn::GatherIndex(kI, first, level),
            hn::Max(hn::Shr(hn::Set(kI, int32_t(texture.width)), level), one),
            hn::Max(hn::Shr(hn::Set(kI, int32_t(texture.height)), level), one)};
}

// What a vector of rays takes from the levels of a texture. Rays have different numbers of samples,
// so they are listed sample by sample, each time those rays that have one more: a loop over a ray's
// own ones ends where no branch predictor expects it.
class LevelSamples {
public:
    // Texels seldom are in the cache: finding them asks for them.
    HWY_INLINE void find(const scene::Texture& texture, const LevelChoice& choice, Vf u, Vf v,
                         uint32_t count) {
        const Vf floor = hn::Floor(choice.level);
        const Vf next = share_of_next(hn::Sub(choice.level, floor));
        const Vi level = hn::ConvertTo(kI, floor);
        const Vi last = hn::Set(kI, int32_t(texture.level_count - 1));
        const Mf rays = hn::FirstN(kF, count);
        count_ = 0;
        add_level(texture, choice, u, v, rays, level, hn::Sub(splat(1.0f), next));
        add_level(texture, choice, u, v, rays, hn::Min(hn::Add(level, hn::Set(kI, 1)), last), next);
    }

    template <class Channel>
    HWY_INLINE void fetch(const scene::Texture& texture, float* rgba) const {
        const auto* texels = reinterpret_cast<const Channel*>(texture.texels.data());
        std::fill_n(rgba, 4 * kLanes, 0.0f);
        for (uint32_t n = 0; n < count_; ++n) {
            const Sample& sample = samples_[n];
            for (uint32_t k = 0; k < sample.ray_count; ++k) {
                const auto j = uint32_t(sample.rays[k]);
                const Texel texel = fetch_sample(texels, texture.sampling, sample.addresses, j);
                float* const sum = rgba + 4 * j;
                store_texel(add_texel(load_sample(sum), scale_texel(texel, sample.share[j])), sum);
            }
        }
    }

private:
    struct Sample {
        HWY_ALIGN int32_t rays[HWY_LANES(float)]; // that have it
        HWY_ALIGN float share[HWY_LANES(float)];  // of each of these in its colour
        TexelAddresses addresses;
        uint32_t ray_count;
    };

    // `share`: what this level is of all.
    HWY_INLINE void add_level(const scene::Texture& texture, const LevelChoice& choice, Vf u, Vf v,
                              Mf rays, Vi level, Vf share) {
        const Mf taken = hn::And(rays, hn::Gt(share, hn::Zero(kF)));
        if (hn::AllFalse(kF, taken)) return;
        const Vf part = hn::Mul(share, choice.part);
        const VectorLevel sizes = level_of(texture, level);
        const Vf step_u = hn::Mul(choice.step_x, splat(1.0f / float(texture.width)));
        const Vf step_v = hn::Mul(choice.step_y, splat(1.0f / float(texture.height)));
        const Vf middle = hn::Mul(hn::Sub(choice.taps, splat(1.0f)), splat(0.5f));
        for (uint32_t k = 0; k < kMostTaps; ++k) {
            const Vf number = splat(float(k));
            const Mf more = hn::And(taken, hn::Lt(number, choice.taps));
            if (hn::AllFalse(kF, more)) return;
            const Vf place = hn::Sub(number, middle);
            Sample& sample = samples_[count_++];
            sample.ray_count = uint32_t(
                hn::CompressStore(hn::Iota(kI, 0), hn::RebindMask(kI, more), kI, sample.rays));
            hn::Store(part, kF, sample.share);
            find_texels(texture, sizes, hn::Add(u, hn::Mul(step_u, place)),
                        hn::Add(v, hn::Mul(step_v, place)), sample.addresses);
            prefetch_texels(texture, sample.addresses);
        }
    }

    uint32_t count_;
    Sample samples_[2 * kMostTaps];
};

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
