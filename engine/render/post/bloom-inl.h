// Rows of the pyramid of a bloom. Included once for each instruction set.
#if defined(PEREGRINE_RENDER_POST_BLOOM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_RENDER_POST_BLOOM_INL_H
#undef PEREGRINE_RENDER_POST_BLOOM_INL_H
#else
#define PEREGRINE_RENDER_POST_BLOOM_INL_H
#endif

#include "render/post/kernels.h"
#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::render::post::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// What part of its light a pixel gives: see OverBright.
HWY_INLINE Vf gain_of(const OverBright& bright, const V3& light) {
    const Vf most = hn::Max(hn::Max(light.x, light.y), light.z);
    const Vf over = hn::Max(hn::Sub(most, splat(bright.threshold)), hn::Zero(kF));
    const Vf limit = splat(bright.limit);
    const Vf part = hn::Div(over, hn::Max(most, splat(1e-30f)));
    return hn::Mul(part, hn::Div(limit, hn::Add(limit, over)));
}

HWY_INLINE V3 load_pixels(const float* const channel[3], size_t i) {
    return {hn::LoadU(kF, channel[0] + i), hn::LoadU(kF, channel[1] + i),
            hn::LoadU(kF, channel[2] + i)};
}

// 1 3 4 4 3 1, in sixteenths.
HWY_INLINE Vf halve(Vf outer, Vf middle, Vf inner) {
    return hn::Add(hn::Add(hn::Mul(outer, splat(1.0f / 16)), hn::Mul(middle, splat(3.0f / 16))),
                   hn::Mul(inner, splat(4.0f / 16)));
}

HWY_ATTR void take_bright(const OverBright& bright, const BrightRows& rows, uint32_t count,
                          float* const sums[3]) {
    for (uint32_t i = 0; i < count; i += kLanes) {
        V3 light[6];
        for (int r = 0; r < 6; ++r) {
            const V3 pixel = load_pixels(rows.row[r], i);
            light[r] = scale(pixel, gain_of(bright, pixel));
        }
        const V3 outer = add(light[0], light[5]), middle = add(light[1], light[4]),
                 inner = add(light[2], light[3]);
        hn::StoreU(halve(outer.x, middle.x, inner.x), kF, sums[0] + i);
        hn::StoreU(halve(outer.y, middle.y, inner.y), kF, sums[1] + i);
        hn::StoreU(halve(outer.z, middle.z, inner.z), kF, sums[2] + i);
    }
}

HWY_ATTR void halve_rows(const float* const rows[6], uint32_t count, float* sum) {
    for (uint32_t i = 0; i < count; i += kLanes) {
        Vf row[6];
        for (int r = 0; r < 6; ++r) row[r] = hn::LoadU(kF, rows[r] + i);
        hn::StoreU(halve(hn::Add(row[0], row[5]), hn::Add(row[1], row[4]), hn::Add(row[2], row[3])),
                   kF, sum + i);
    }
}

HWY_ATTR void halve_columns(const float* sum, uint32_t count, float* half) {
    for (uint32_t i = 0; i < count; i += kLanes) {
        Vf pair[3][2]; // the even and the odd ones
        for (ptrdiff_t k = 0; k < 3; ++k)
            hn::LoadInterleaved2(kF, sum + 2 * (k - 1) + 2 * i, pair[k][0], pair[k][1]);
        hn::StoreU(halve(hn::Add(pair[0][0], pair[2][1]), hn::Add(pair[0][1], pair[2][0]),
                         hn::Add(pair[1][0], pair[1][1])),
                   kF, half + i);
    }
}

// 1 5 7 3, in sixteenths.
HWY_INLINE Vf tent(Vf a, Vf b, Vf c, Vf d) {
    return hn::Add(hn::Add(hn::Mul(a, splat(1.0f / 16)), hn::Mul(b, splat(5.0f / 16))),
                   hn::Add(hn::Mul(c, splat(7.0f / 16)), hn::Mul(d, splat(3.0f / 16))));
}

HWY_ATTR void double_rows(const float* const rows[4], uint32_t count, float* sum) {
    for (uint32_t i = 0; i < count; i += kLanes)
        hn::StoreU(tent(hn::LoadU(kF, rows[0] + i), hn::LoadU(kF, rows[1] + i),
                        hn::LoadU(kF, rows[2] + i), hn::LoadU(kF, rows[3] + i)),
                   kF, sum + i);
}

HWY_ATTR void double_columns(const float* sum, uint32_t count, float* twice) {
    for (uint32_t i = 0; i < count; i += kLanes) {
        Vf c[5];
        for (ptrdiff_t k = 0; k < 5; ++k) c[k] = hn::LoadU(kF, sum + (k - 2) + i);
        hn::StoreInterleaved2(tent(c[0], c[1], c[2], c[3]), tent(c[4], c[3], c[2], c[1]), kF,
                              twice + 2 * i);
    }
}

HWY_ATTR void mix(float weight, const float* with, uint32_t count, float* values) {
    const Vf here = splat(weight), there = splat(1.0f - weight);
    for (uint32_t i = 0; i < count; i += kLanes)
        hn::StoreU(hn::Add(hn::Mul(hn::LoadU(kF, values + i), here),
                           hn::Mul(hn::LoadU(kF, with + i), there)),
                   kF, values + i);
}

HWY_ATTR void spread(const OverBright& bright, const float* const glow[3], uint32_t count,
                     float* const light[3]) {
    const Vf strength = splat(bright.strength);
    for (uint32_t i = 0; i < count; i += kLanes) {
        const V3 pixel{hn::LoadU(kF, light[0] + i), hn::LoadU(kF, light[1] + i),
                       hn::LoadU(kF, light[2] + i)};
        const Vf kept = hn::Sub(splat(1.0f), hn::Mul(strength, gain_of(bright, pixel)));
        const V3 sum = add(scale(pixel, kept), scale(load_pixels(glow, i), strength));
        hn::StoreU(sum.x, kF, light[0] + i);
        hn::StoreU(sum.y, kF, light[1] + i);
        hn::StoreU(sum.z, kF, light[2] + i);
    }
}

} // namespace peregrine::render::post::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
