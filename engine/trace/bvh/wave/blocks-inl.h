// A ray of a wave and a block of four triangles. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_WAVE_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_WAVE_BLOCKS_INL_H
#undef PEREGRINE_TRACE_BVH_WAVE_BLOCKS_INL_H
#else
#define PEREGRINE_TRACE_BVH_WAVE_BLOCKS_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/tree/block-inl.h"
#include "trace/bvh/wave/rays-inl.h"

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

HWY_INLINE HWY_ATTR Sheared<V4> relative_to(const WaveRay& ray, const Block& block) {
    return relative_to(block, ray.kx, ray.ky, ray.kz, hn::Set(k4, ray.ox), hn::Set(k4, ray.oy),
                       hn::Set(k4, ray.oz), hn::Set(k4, ray.sx), hn::Set(k4, ray.sy));
}

// Two rays, one in each half of a vector, and the triangles of a block.
struct TwoRays {
    Sheared<V8> sheared;
    V8 z_min, z_max, scale;

    HWY_INLINE HWY_ATTR TwoRays(const WaveRay& a, const WaveRay& b, const Block& block) {
        const auto join = [](const float* low, const float* high) HWY_ATTR {
            return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(low)), _mm_load_ps(high),
                                        1);
        };
        const __m256 first = join(&a.ox, &b.ox), second = join(&a.sy, &b.sy);
        const V8 ox{_mm256_permute_ps(first, 0x00)}, oy{_mm256_permute_ps(first, 0x55)},
            oz{_mm256_permute_ps(first, 0xAA)}, sx{_mm256_permute_ps(first, 0xFF)},
            sy{_mm256_permute_ps(second, 0x00)};
        z_min = V8{_mm256_permute_ps(second, 0x55)};
        z_max = V8{_mm256_permute_ps(second, 0xAA)};
        scale = V8{_mm256_permute_ps(second, 0xFF)};
        const auto corner = [&](uint32_t vertex, V8 & x, V8 & y, V8 & z) HWY_ATTR
            __attribute__((always_inline)) {
            const float* p = &block.vertex[vertex][0][0];
            z = hn::Sub(V8{join(p + a.kz, p + b.kz)}, oz);
            x = shear(hn::Sub(V8{join(p + a.kx, p + b.kx)}, ox), sx, z);
            y = shear(hn::Sub(V8{join(p + a.ky, p + b.ky)}, oy), sy, z);
        };
        corner(0, sheared.ax, sheared.ay, sheared.az);
        corner(1, sheared.bx, sheared.by, sheared.bz);
        corner(2, sheared.cx, sheared.cy, sheared.cz);
    }
};

// What float tells of two rays and four triangles, in bits 0 to 3 and 4 to 7.
struct Verdict {
    uint32_t hit;   // for sure
    uint32_t maybe; // not missed for sure

    HWY_INLINE HWY_ATTR Verdict(const WaveRay& a, const WaveRay& b, const Block& block) {
        const TwoRays rays(a, b, block);
        const EdgeSigns<V8> edges(rays.sheared);
        const RangeMargin<V8> range(rays.sheared, edges, rays.z_min, rays.z_max, rays.scale);
        hit = bits_of(k8, hn::And(edges.inside, range.in_range()));
        maybe =
            bits_of(k8, hn::Not(hn::Or(edges.outside, hn::Lt(range.margin, hn::Neg(range.error)))));
    }
};

// The float filter: the triangles that it lets through.
HWY_INLINE HWY_ATTR uint32_t maybe_of_two(const WaveRay& a, const WaveRay& b, const Block& block) {
    return ~bits_of(k8, outside(TwoRays(a, b, block).sheared)) & 255u;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
