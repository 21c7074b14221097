// Texture filtering. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_TEXELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_TEXELS_INL_H
#undef PEREGRINE_SHADE_TEXELS_INL_H
#else
#define PEREGRINE_SHADE_TEXELS_INL_H
#endif

#include <hwy/cache_control.h>

#include "scene/texture_sampling.h"
#include "shade/surface/footprint-inl.h"
#include "shade/surface/weights-inl.h"

#include <algorithm>

// The operations of scene/texture_sampling.h in the same order: addresses for a vector of rays at a
// time, texels one ray at a time with the four channels side by side.
HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
struct Texel {
    float c[4];
};

template <class Function>
HWY_INLINE Texel each_channel(Function&& function) {
    return {{function(0), function(1), function(2), function(3)}};
}

HWY_INLINE Texel load_texel(const float* t) {
    return each_channel([&](int k) HWY_ATTR { return t[k]; });
}
HWY_INLINE Texel load_texel(const uint16_t* t) {
    return each_channel([&](int k) HWY_ATTR { return float(t[k]); });
}
HWY_INLINE Texel mix(const Texel& a, const Texel& b, float weight) {
    return each_channel([&](int k) HWY_ATTR { return a.c[k] + (b.c[k] - a.c[k]) * weight; });
}
HWY_INLINE Texel load_sample(const float* t) {
    return load_texel(t);
}
HWY_INLINE void store_texel(const Texel& t, float* out) {
    std::copy_n(t.c, 4, out);
}
HWY_INLINE Texel scale_texel(const Texel& t, float weight) {
    return each_channel([&](int k) HWY_ATTR { return t.c[k] * weight; });
}
HWY_INLINE Texel add_texel(const Texel& a, const Texel& b) {
    return each_channel([&](int k) HWY_ATTR { return a.c[k] + b.c[k]; });
}
#else
using D4 = hn::FixedTag<float, 4>;
using Texel = hn::Vec<D4>;
inline constexpr D4 kTexel;

HWY_INLINE Texel load_texel(const float* t) {
    return hn::LoadU(kTexel, t);
}
HWY_INLINE Texel load_texel(const uint16_t* t) {
    const auto fixed = hn::LoadU(hn::FixedTag<uint16_t, 4>(), t);
    return hn::ConvertTo(kTexel, hn::PromoteTo(hn::FixedTag<int32_t, 4>(), fixed));
}
HWY_INLINE Texel mix(Texel a, Texel b, float weight) {
    return hn::Add(a, hn::Mul(hn::Sub(b, a), hn::Set(kTexel, weight)));
}
HWY_INLINE Texel load_sample(const float* t) {
    return hn::Load(kTexel, t);
}
HWY_INLINE void store_texel(Texel t, float* out) {
    hn::Store(t, kTexel, out);
}
HWY_INLINE Texel scale_texel(Texel t, float weight) {
    return hn::Mul(t, hn::Set(kTexel, weight));
}
HWY_INLINE Texel add_texel(Texel a, Texel b) {
    return hn::Add(a, b);
}
#endif

// The four texels of a bilinear sample, each row from its first texel and its second one, which is
// `step` channels on: nearly always the next.
#if HWY_MAX_BYTES >= 32 && HWY_TARGET != HWY_SCALAR
using D8 = hn::FixedTag<float, 8>;
inline constexpr D8 kPair;

HWY_INLINE hn::Vec<D8> load_pair(const float* first, ptrdiff_t step) {
    if (HWY_LIKELY(step == 4)) return hn::LoadU(kPair, first);
    return hn::Combine(kPair, hn::LoadU(kTexel, first + step), hn::LoadU(kTexel, first));
}
HWY_INLINE hn::Vec<D8> load_pair(const uint16_t* first, ptrdiff_t step) {
    constexpr hn::FixedTag<uint16_t, 8> both;
    constexpr hn::FixedTag<uint16_t, 4> one;
    const auto fixed = HWY_LIKELY(step == 4)
                           ? hn::LoadU(both, first)
                           : hn::Combine(both, hn::LoadU(one, first + step), hn::LoadU(one, first));
    return hn::ConvertTo(kPair, hn::PromoteTo(hn::FixedTag<int32_t, 8>(), fixed));
}

// Both rows side by side along x, then one from the other along y.
template <class Channel>
HWY_INLINE Texel bilinear(const Channel* top, const Channel* bottom, ptrdiff_t step, float x,
                          float y) {
    const auto upper = load_pair(top, step), lower = load_pair(bottom, step);
    const auto first = hn::ConcatLowerLower(kPair, lower, upper);
    const auto second = hn::ConcatUpperUpper(kPair, lower, upper);
    const auto rows = hn::Add(first, hn::Mul(hn::Sub(second, first), hn::Set(kPair, x)));
    return mix(hn::LowerHalf(kTexel, rows), hn::UpperHalf(kTexel, rows), y);
}
#else
template <class Channel>
HWY_INLINE Texel bilinear(const Channel* top, const Channel* bottom, ptrdiff_t step, float x,
                          float y) {
    return mix(mix(load_texel(top), load_texel(top + step), x),
               mix(load_texel(bottom), load_texel(bottom + step), x), y);
}
#endif

HWY_INLINE Vf fold(Vf x, scene::Wrap wrap) {
    const Vf one = splat(1.0f);
    Vf folded;
    if (wrap == scene::Wrap::repeat) {
        folded = hn::Sub(x, hn::Floor(x));
    } else if (wrap == scene::Wrap::mirror) {
        const Vf m = hn::Sub(x, hn::Mul(splat(2.0f), hn::Floor(hn::Mul(x, splat(0.5f)))));
        folded = hn::IfThenElse(hn::Gt(m, one), hn::Sub(splat(2.0f), m), m);
    } else {
        folded = hn::IfThenElse(hn::Lt(x, one), x, one);
        folded = hn::IfThenElseZero(hn::Gt(x, hn::Zero(kF)), folded);
    }
    return hn::IfThenElseZero(hn::And(hn::Ge(folded, hn::Zero(kF)), hn::Le(folded, one)), folded);
}

struct VectorTaps {
    Vi first, second;
    Vf weight;
};

// `last`: size - 1.
HWY_INLINE VectorTaps bilinear_taps(Vf coordinate, scene::Wrap wrap, Vf size, Vi last) {
    const Vf x = hn::Sub(hn::Mul(fold(coordinate, wrap), size), splat(0.5f));
    const Vf floor = hn::Floor(x);
    const Vi index = hn::ConvertTo(kI, floor);
    const Vi before = wrap == scene::Wrap::repeat ? last : hn::Zero(kI);
    const Vi after = wrap == scene::Wrap::repeat ? hn::Zero(kI) : last;
    const Vi next = hn::Add(index, hn::Set(kI, 1));
    return {hn::IfThenElse(hn::Lt(index, hn::Zero(kI)), before, index),
            hn::IfThenElse(hn::Eq(index, last), after, next), hn::Sub(x, floor)};
}

HWY_INLINE Vi nearest_tap(Vf coordinate, scene::Wrap wrap, Vf size, Vi last) {
    return hn::Min(hn::ConvertTo(kI, hn::Mul(fold(coordinate, wrap), size)), last);
}

// A level of a texture, or one for each ray.
struct VectorLevel {
    Vi first; // texel
    Vf width, height;
    Vi last_x, last_y, row; // texels from row to row

    HWY_INLINE VectorLevel(Vi first_, Vi width_, Vi height_)
        : first(first_), width(hn::ConvertTo(kF, width_)), height(hn::ConvertTo(kF, height_)),
          last_x(hn::Sub(width_, hn::Set(kI, 1))), last_y(hn::Sub(height_, hn::Set(kI, 1))),
          row(width_) {}
};

HWY_INLINE VectorLevel finest_level(const scene::Texture& texture) {
    return {hn::Zero(kI), hn::Set(kI, int32_t(texture.width)),
            hn::Set(kI, int32_t(texture.height))};
}

// Where the texels of one vector of rays lie, in texels from the texture's first: the first one of
// either row, and from each to the second one.
struct TexelAddresses {
    HWY_ALIGN int32_t top[HWY_LANES(float)]; // nearest: this alone
    HWY_ALIGN int32_t bottom[HWY_LANES(float)];
    HWY_ALIGN int32_t step[HWY_LANES(float)];
    HWY_ALIGN float weight_x[HWY_LANES(float)];
    HWY_ALIGN float weight_y[HWY_LANES(float)];
};

HWY_INLINE void find_texels(const scene::Texture& texture, const VectorLevel& level, Vf u, Vf v,
                            TexelAddresses& out) {
    if (texture.sampling == scene::Sampling::nearest) {
        const Vi x = nearest_tap(u, texture.wrap_u, level.width, level.last_x);
        const Vi y = nearest_tap(v, texture.wrap_v, level.height, level.last_y);
        return hn::Store(hn::Add(level.first, hn::Add(hn::Mul(y, level.row), x)), kI, out.top);
    }
    const VectorTaps x = bilinear_taps(u, texture.wrap_u, level.width, level.last_x);
    const VectorTaps y = bilinear_taps(v, texture.wrap_v, level.height, level.last_y);
    const Vi left = hn::Add(level.first, x.first);
    hn::Store(hn::Add(left, hn::Mul(y.first, level.row)), kI, out.top);
    hn::Store(hn::Add(left, hn::Mul(y.second, level.row)), kI, out.bottom);
    hn::Store(hn::Sub(x.second, x.first), kI, out.step);
    hn::Store(x.weight, kF, out.weight_x);
    hn::Store(y.weight, kF, out.weight_y);
}

// The sample of one ray.
template <class Channel>
HWY_INLINE Texel fetch_sample(const Channel* texels, scene::Sampling sampling,
                              const TexelAddresses& addresses, uint32_t lane) {
    const Channel* const top = texels + size_t(uint32_t(addresses.top[lane])) * 4;
    if (sampling == scene::Sampling::nearest) return load_texel(top);
    const Channel* const bottom = texels + size_t(uint32_t(addresses.bottom[lane])) * 4;
    return bilinear(top, bottom, ptrdiff_t(addresses.step[lane]) * 4, addresses.weight_x[lane],
                    addresses.weight_y[lane]);
}

template <class Channel>
HWY_INLINE void fetch_samples(const scene::Texture& texture, const TexelAddresses& addresses,
                              uint32_t count, float* rgba) {
    const auto* texels = reinterpret_cast<const Channel*>(texture.texels.data());
    for (uint32_t j = 0; j < count; ++j)
        store_texel(fetch_sample(texels, texture.sampling, addresses, j), rgba + 4 * j);
}

HWY_INLINE void prefetch_texels(const scene::Texture& texture, const TexelAddresses& addresses) {
    const auto* texels = texture.texels.data();
    const size_t size = texture.texel_size();
    const int32_t* const bottom =
        texture.sampling == scene::Sampling::nearest ? addresses.top : addresses.bottom;
    for (uint32_t j = 0; j < kLanes; ++j) {
        hwy::Prefetch(texels + size_t(uint32_t(addresses.top[j])) * size);
        hwy::Prefetch(texels + size_t(uint32_t(bottom[j])) * size);
    }
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
