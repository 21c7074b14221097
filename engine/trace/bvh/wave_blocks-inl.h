// A ray of a wave and a block of four triangles: geometry/intersect.h, lane by lane, the same
// operations in the same order. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_WAVE_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_WAVE_BLOCKS_INL_H
#undef PEREGRINE_TRACE_BVH_WAVE_BLOCKS_INL_H
#else
#define PEREGRINE_TRACE_BVH_WAVE_BLOCKS_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "trace/bvh/lanes-inl.h"
#include "trace/bvh/wave_rays-inl.h"

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using accel::bvh::Block;

struct WaveHits {
    uint32_t lanes; // bits
    uint32_t back_faces;
    alignas(16) float t[4], u[4], v[4]; // of `lanes`
};

// Vertices relative to the ray.
struct WaveBlock {
    V4 ax, ay, az, bx, by, bz, cx, cy, cz;

    HWY_INLINE HWY_ATTR WaveBlock(const WaveRay& ray, const Block& block) {
        const V4 ox = hn::Set(k4, ray.ox), oy = hn::Set(k4, ray.oy), oz = hn::Set(k4, ray.oz);
        const V4 sx = hn::Set(k4, ray.sx), sy = hn::Set(k4, ray.sy);
        const char* bytes = reinterpret_cast<const char*>(&block);
        const auto load = [&](uint32_t vertex, uint32_t axis) HWY_ATTR {
            return hn::Load(k4, reinterpret_cast<const float*>(bytes + axis + 48 * vertex));
        };
        const auto shear = [&](uint32_t vertex, V4& x, V4& y, V4& z) HWY_ATTR {
            z = hn::Sub(load(vertex, ray.kz), oz);
            x = hn::Sub(hn::Sub(load(vertex, ray.kx), ox), hn::Mul(sx, z));
            y = hn::Sub(hn::Sub(load(vertex, ray.ky), oy), hn::Mul(sy, z));
        };
        shear(0, ax, ay, az);
        shear(1, bx, by, bz);
        shear(2, cx, cy, cz);
    }

    // Lanes that the exact edge functions cannot reject for their signs.
    HWY_INLINE HWY_ATTR uint32_t maybe() const {
        const V4 u = hn::Sub(hn::Mul(cx, by), hn::Mul(cy, bx));
        const V4 v = hn::Sub(hn::Mul(ax, cy), hn::Mul(ay, cx));
        const V4 w = hn::Sub(hn::Mul(bx, ay), hn::Mul(by, ax));
        const V4 zero = hn::Zero(k4);
        const auto outside = hn::And(hn::Lt(hn::Min(u, hn::Min(v, w)), zero),
                                     hn::Gt(hn::Max(u, hn::Max(v, w)), zero));
        return ~bits_of(k4, outside) & 15u;
    }

    // Steps 4 to 6. Without `Details` it gives the lanes alone.
    template <bool Details>
    HWY_INLINE HWY_ATTR void decide(const WaveRay& ray, WaveHits& hits) const {
        const auto wide = [](V4 x) HWY_ATTR { return hn::PromoteTo(kD, x); };
        const Vd dax = wide(ax), day = wide(ay), dbx = wide(bx), dby = wide(by), dcx = wide(cx),
                 dcy = wide(cy);
        const Vd dz = hn::Set(kD, double(ray.dz));
        const Vd u = hn::Sub(hn::Mul(dcx, dby), hn::Mul(dcy, dbx));
        const Vd v = hn::Sub(hn::Mul(dax, dcy), hn::Mul(day, dcx));
        const Vd w = hn::Sub(hn::Mul(dbx, day), hn::Mul(dby, dax));
        const Vd zero = hn::Zero(kD);
        const auto outside = hn::And(hn::Lt(hn::Min(u, hn::Min(v, w)), zero),
                                     hn::Gt(hn::Max(u, hn::Max(v, w)), zero));
        const Vd det = hn::Add(hn::Add(u, v), w);
        const auto missed = hn::Or(outside, hn::Eq(det, zero));
        const Vd depth =
            hn::Add(hn::Add(hn::Mul(u, wide(az)), hn::Mul(v, wide(bz))), hn::Mul(w, wide(cz)));
        const Vd r = hn::Div(hn::Set(kD, 1.0), hn::Mul(det, dz));
        const V4 t = hn::DemoteTo(k4, hn::Mul(depth, r));
        const auto in_range =
            hn::And(hn::Ge(t, hn::Set(k4, ray.t_min)), hn::Le(t, hn::Set(k4, ray.t_max)));
        hits.lanes = bits_of(k4, in_range) & ~bits_of(kD, missed);
        if (!Details) return;
        hn::Store(t, k4, hits.t);
        hn::Store(hn::DemoteTo(k4, hn::Mul(hn::Mul(v, dz), r)), k4, hits.u);
        hn::Store(hn::DemoteTo(k4, hn::Mul(hn::Mul(w, dz), r)), k4, hits.v);
        // det is not 0 in these lanes; its sign differs from dz's on the back.
        hits.back_faces =
            bits_of(kD, hn::Lt(hn::CopySign(hn::Set(kD, 1.0), hn::Xor(det, dz)), zero));
    }
};

// WaveBlock::maybe of two rays at a time, a ray in each half of a vector: bits 0 to 3 and 4 to 7.
HWY_INLINE HWY_ATTR uint32_t maybe_of_two(const WaveRay& a, const WaveRay& b, const Block& block) {
    const auto join = [](const float* low, const float* high) HWY_ATTR {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(low)), _mm_load_ps(high), 1);
    };
    const __m256 first = join(&a.ox, &b.ox), second = join(&a.sy, &b.sy);
    const V8 ox{_mm256_permute_ps(first, 0x00)}, oy{_mm256_permute_ps(first, 0x55)},
        oz{_mm256_permute_ps(first, 0xAA)}, sx{_mm256_permute_ps(first, 0xFF)},
        sy{_mm256_permute_ps(second, 0x00)};
    const char* bytes = reinterpret_cast<const char*>(&block);
    const auto shear = [&](uint32_t vertex, V8& x, V8& y) HWY_ATTR {
        const auto load = [&](uint32_t axis_a, uint32_t axis_b) HWY_ATTR {
            return V8{join(reinterpret_cast<const float*>(bytes + axis_a + 48 * vertex),
                           reinterpret_cast<const float*>(bytes + axis_b + 48 * vertex))};
        };
        const V8 z = hn::Sub(load(a.kz, b.kz), oz);
        x = hn::Sub(hn::Sub(load(a.kx, b.kx), ox), hn::Mul(sx, z));
        y = hn::Sub(hn::Sub(load(a.ky, b.ky), oy), hn::Mul(sy, z));
    };
    V8 ax, ay, bx, by, cx, cy;
    shear(0, ax, ay);
    shear(1, bx, by);
    shear(2, cx, cy);
    const V8 u = hn::Sub(hn::Mul(cx, by), hn::Mul(cy, bx));
    const V8 v = hn::Sub(hn::Mul(ax, cy), hn::Mul(ay, cx));
    const V8 w = hn::Sub(hn::Mul(bx, ay), hn::Mul(by, ax));
    const V8 zero = hn::Zero(k8);
    const auto outside =
        hn::And(hn::Lt(hn::Min(u, hn::Min(v, w)), zero), hn::Gt(hn::Max(u, hn::Max(v, w)), zero));
    return ~bits_of(k8, outside) & 255u;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
