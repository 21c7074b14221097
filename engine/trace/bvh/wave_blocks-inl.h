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

    // Steps 4 to 6.
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
        hn::Store(t, k4, hits.t);
        hn::Store(hn::DemoteTo(k4, hn::Mul(hn::Mul(v, dz), r)), k4, hits.u);
        hn::Store(hn::DemoteTo(k4, hn::Mul(hn::Mul(w, dz), r)), k4, hits.v);
        // det is not 0 in these lanes; its sign differs from dz's on the back.
        hits.back_faces =
            bits_of(kD, hn::Lt(hn::CopySign(hn::Set(kD, 1.0), hn::Xor(det, dz)), zero));
    }
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
