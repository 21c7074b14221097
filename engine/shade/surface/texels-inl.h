// Texture filtering. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_TEXELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_TEXELS_INL_H
#undef PEREGRINE_SHADE_TEXELS_INL_H
#else
#define PEREGRINE_SHADE_TEXELS_INL_H
#endif

#include <hwy/cache_control.h>

#include "scene/texture_sampling.h"
#include "shade/surface/triangle_shading.h"
#include "shade/surface/weights-inl.h"

#include <algorithm>

// The operations of scene/texture_sampling.h in the same order: addresses for a vector of rays at a
// time, texels one ray at a time with the four channels side by side.
HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using Di = hn::ScalableTag<int32_t>;
using Vi = hn::Vec<Di>;
inline constexpr Di kI;

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
HWY_INLINE void store_texel(const Texel& t, float* out) {
    std::copy_n(t.c, 4, out);
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
HWY_INLINE void store_texel(Texel t, float* out) {
    hn::Store(t, kTexel, out);
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

HWY_INLINE VectorTaps bilinear_taps(Vf coordinate, scene::Wrap wrap, uint32_t size) {
    const Vf x = hn::Sub(hn::Mul(fold(coordinate, wrap), splat(float(size))), splat(0.5f));
    const Vf floor = hn::Floor(x);
    const Vi index = hn::ConvertTo(kI, floor);
    const Vi last = hn::Set(kI, int32_t(size) - 1);
    const Vi before = wrap == scene::Wrap::repeat ? last : hn::Zero(kI);
    const Vi after = wrap == scene::Wrap::repeat ? hn::Zero(kI) : last;
    const Vi next = hn::Add(index, hn::Set(kI, 1));
    return {hn::IfThenElse(hn::Lt(index, hn::Zero(kI)), before, index),
            hn::IfThenElse(hn::Eq(index, last), after, next), hn::Sub(x, floor)};
}

HWY_INLINE Vi nearest_tap(Vf coordinate, scene::Wrap wrap, uint32_t size) {
    const Vi index = hn::ConvertTo(kI, hn::Mul(fold(coordinate, wrap), splat(float(size))));
    return hn::Min(index, hn::Set(kI, int32_t(size) - 1));
}

// Where the texels of one vector of rays lie, in texels from the first.
struct TexelAddresses {
    HWY_ALIGN int32_t at[4][HWY_LANES(float)]; // nearest: only at[0]
    HWY_ALIGN float weight_x[HWY_LANES(float)];
    HWY_ALIGN float weight_y[HWY_LANES(float)];
};

HWY_INLINE void find_texels(const scene::Texture& texture, Vf u, Vf v, TexelAddresses& out) {
    const Vi width = hn::Set(kI, int32_t(texture.width));
    if (texture.sampling == scene::Sampling::nearest) {
        const Vi x = nearest_tap(u, texture.wrap_u, texture.width);
        const Vi y = nearest_tap(v, texture.wrap_v, texture.height);
        return hn::Store(hn::Add(hn::Mul(y, width), x), kI, out.at[0]);
    }
    const VectorTaps x = bilinear_taps(u, texture.wrap_u, texture.width);
    const VectorTaps y = bilinear_taps(v, texture.wrap_v, texture.height);
    const Vi row0 = hn::Mul(y.first, width), row1 = hn::Mul(y.second, width);
    hn::Store(hn::Add(row0, x.first), kI, out.at[0]);
    hn::Store(hn::Add(row0, x.second), kI, out.at[1]);
    hn::Store(hn::Add(row1, x.first), kI, out.at[2]);
    hn::Store(hn::Add(row1, x.second), kI, out.at[3]);
    hn::Store(x.weight, kF, out.weight_x);
    hn::Store(y.weight, kF, out.weight_y);
}

template <class Channel>
HWY_INLINE void fetch_texels(const scene::Texture& texture, const TexelAddresses& addresses,
                             uint32_t count, float* rgba) {
    const auto* texels = reinterpret_cast<const Channel*>(texture.texels.data());
    const auto texel = [&](int corner, uint32_t lane) HWY_ATTR {
        return load_texel(texels + size_t(uint32_t(addresses.at[corner][lane])) * 4);
    };
    if (texture.sampling == scene::Sampling::nearest) {
        for (uint32_t j = 0; j < count; ++j) store_texel(texel(0, j), rgba + 4 * j);
        return;
    }
    for (uint32_t j = 0; j < count; ++j) {
        const Texel top = mix(texel(0, j), texel(1, j), addresses.weight_x[j]);
        const Texel bottom = mix(texel(2, j), texel(3, j), addresses.weight_x[j]);
        store_texel(mix(top, bottom, addresses.weight_y[j]), rgba + 4 * j);
    }
}

HWY_INLINE void prefetch_texels(const scene::Texture& texture, const TexelAddresses& addresses) {
    const auto* texels = texture.texels.data();
    const size_t size = texture.storage == scene::Texture::Storage::unorm16 ? 8 : 16;
    const int second_row = texture.sampling == scene::Sampling::nearest ? 0 : 2;
    for (uint32_t j = 0; j < kLanes; ++j) {
        hwy::Prefetch(texels + size_t(uint32_t(addresses.at[0][j])) * size);
        hwy::Prefetch(texels + size_t(uint32_t(addresses.at[second_row][j])) * size);
    }
}

// Calls use(i, colour) for each vector i of the rays [begin, end), all of which hit the triangle.
// Texels seldom are in the cache: each vector's are asked for while the previous one is filtered.
template <class Use>
HWY_INLINE void sample_texture(const TextureOnTriangle& placed, const float* u, const float* v,
                               uint32_t begin, uint32_t end, Use&& use) {
    const scene::Texture& texture = *placed.texture;
    const Vf scale_by = splat(scene::texel_scale(texture));
    TexelAddresses addresses[2];
    HWY_ALIGN float rgba[4 * HWY_LANES(float)];
    for (uint32_t k = 0; k < 4; ++k) hn::Store(hn::Zero(kF), kF, rgba + k * kLanes);
    const auto address = [&](uint32_t i, TexelAddresses& out) HWY_ATTR {
        const Weights w = weights(u, v, i);
        find_texels(texture, blend(w, placed.uv[0].x, placed.uv[1].x, placed.uv[2].x),
                    blend(w, placed.uv[0].y, placed.uv[1].y, placed.uv[2].y), out);
        prefetch_texels(texture, out);
    };
    address(begin, addresses[0]);
    uint32_t current = 0;
    for (uint32_t i = begin; i < end; i += kLanes, current ^= 1) {
        if (i + kLanes < end) address(i + kLanes, addresses[current ^ 1]);
        const uint32_t count = std::min(end - i, kLanes);
        if (texture.storage == scene::Texture::Storage::unorm16)
            fetch_texels<uint16_t>(texture, addresses[current], count, rgba);
        else
            fetch_texels<float>(texture, addresses[current], count, rgba);
        Vf r, g, b, a;
        hn::LoadInterleaved4(kF, rgba, r, g, b, a);
        use(i, scale(V3{r, g, b}, scale_by));
    }
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
