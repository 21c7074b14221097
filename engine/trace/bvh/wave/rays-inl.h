// The rays of a wave: what traversal needs of a ray in two cache lines, set up for eight rays of a
// stream at a time. Included once for each instruction set, where a vector has eight floats.
#if defined(PEREGRINE_TRACE_BVH_WAVE_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_WAVE_RAYS_INL_H
#undef PEREGRINE_TRACE_BVH_WAVE_RAYS_INL_H
#else
#define PEREGRINE_TRACE_BVH_WAVE_RAYS_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "simd/lanes-inl.h"
#include "simd/transpose-inl.h"
#include "trace/bvh/wave/swept-inl.h"
#include "trace/kernels.h"
#include "trace/slabs.h"

#include <cstddef>
#include <limits>

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// The first line is what nodes ask for, the second what blocks do.
struct alignas(64) WaveRay {
    float inverse[3], enter[3], leave[3]; // as in NodeRay
    float t_near, t_limit;
    uint32_t octant;
    uint32_t steps;
    uint32_t index; // in the stream
    uint32_t unused[2];

    float ox, oy, oz, sx, sy, z_min, z_max, scale; // as in BlockRay
    uint8_t kx, ky, kz, none; // offsets of axes in a vertex of a block, in floats
    float dz, t_min, t_max;
    uint32_t best; // key of the triangle
    uint32_t padding[3];
};
static_assert(sizeof(WaveRay) == 128);
static_assert(offsetof(WaveRay, leave) == 24 && offsetof(WaveRay, octant) == 44);
static_assert(offsetof(WaveRay, ox) == 64 && offsetof(WaveRay, kx) == 96);

struct Launched {
    uint32_t alive;     // bits: rays that may touch the scene
    uint32_t irregular; // bits: float lacks the range for these
};

// Rays `first` to first + 7 of the stream, as far as there are so many, into eight `places`. The
// arithmetic is that of trace/slabs.h and geometry::shear, lane by lane.
inline HWY_ATTR Launched launch(const math::Box& bounds, const RayStream& rays, uint32_t first,
                                WaveRay* places, Swept& swept) {
    const hn::RebindToUnsigned<D8> u8;
    const uint32_t there = rays.count - first >= 8 ? 255u : (1u << (rays.count - first)) - 1;
    V8 o[3], d[3], size[3];
    V8 distance = hn::Zero(k8);
    for (int k = 0; k < 3; ++k) {
        o[k] = hn::LoadU(k8, rays.origin[k] + first);
        d[k] = hn::LoadU(k8, rays.direction[k] + first);
        size[k] = hn::Abs(d[k]);
        const V8 lower = hn::Abs(hn::Sub(hn::Set(k8, bounds.lower[k]), o[k]));
        const V8 upper = hn::Abs(hn::Sub(hn::Set(k8, bounds.upper[k]), o[k]));
        distance = hn::Max(hn::Max(lower, upper), distance);
    }
    const V8 largest = hn::Max(hn::Max(size[0], size[1]), size[2]);
    const M8 fits = hn::And(
        hn::And(hn::Ge(largest, hn::Set(k8, 0x1p-32f)), hn::Le(largest, hn::Set(k8, 0x1p32f))),
        hn::And(hn::Ge(distance, hn::Set(k8, 0x1p-40f)), hn::Le(distance, hn::Set(k8, 0x1p60f))));
    const V8 one = hn::Set(k8, 1.0f);
    const V8 error = hn::Add(hn::Mul(hn::Set(k8, 0x1p-20f), distance), hn::Set(k8, 0x1p-146f));
    const V8 smallest = hn::Mul(hn::Set(k8, 0x1p-26f), largest);
    V8 row[8], column[8];
    V8 t_near = hn::LoadU(k8, rays.t_min + first), t_far = hn::LoadU(k8, rays.t_max + first);
    const V8 t_min = hn::Max(t_near, hn::Set(k8, std::numeric_limits<float>::lowest()));
    const V8 t_max = hn::Min(t_far, hn::Set(k8, std::numeric_limits<float>::max()));
    V8 inverse[3], enter[3], leave[3];
    auto octant = hn::Zero(u8);
    for (int k = 0; k < 3; ++k) {
        const V8 kept =
            hn::IfThenElse(hn::Lt(size[k], smallest), hn::CopySign(smallest, d[k]), d[k]);
        inverse[k] = hn::Div(one, kept);
        const V8 slab_margin = hn::Add(hn::Mul(error, hn::Abs(inverse[k])), hn::Set(k8, 0x1p-149f));
        const V8 lower = hn::Mul(hn::Sub(hn::Set(k8, bounds.lower[k]), o[k]), inverse[k]);
        const V8 upper = hn::Mul(hn::Sub(hn::Set(k8, bounds.upper[k]), o[k]), inverse[k]);
        t_near = hn::Max(hn::Sub(hn::Min(lower, upper), slab_margin), t_near);
        t_far = hn::Min(hn::Add(hn::Max(lower, upper), slab_margin), t_far);
        const V8 offset = hn::Mul(o[k], inverse[k]);
        const V8 margin = hn::Add(slab_margin, hn::Mul(hn::Set(k8, 0x1p-22f), hn::Abs(offset)));
        enter[k] = hn::Sub(hn::Neg(offset), margin);
        leave[k] = hn::Sub(margin, offset);
        const auto negative = hn::RebindMask(u8, hn::Lt(inverse[k], hn::Zero(k8)));
        octant = hn::Or(octant, hn::IfThenElseZero(negative, hn::Set(u8, 1u << k)));
    }
    const M8 alive = hn::And(fits, hn::Le(t_near, t_far));
    swept.add(hn::And(alive, hn::FirstN(k8, rays.count - first)), o, d, t_near, t_far, distance);
    const auto put = [&](size_t offset) HWY_ATTR {
        transpose(row, column);
        for (int i = 0; i < 8; ++i)
            hn::Store(column[i], k8,
                      reinterpret_cast<float*>(reinterpret_cast<char*>(places + i) + offset));
    };
    const auto as_float = [](auto x) HWY_ATTR { return hn::BitCast(k8, x); };
    for (int k = 0; k < 3; ++k) {
        row[k] = inverse[k];
        row[3 + k] = enter[k];
    }
    row[6] = leave[0];
    row[7] = leave[1];
    put(0);
    row[0] = leave[2];
    row[1] = t_near;
    row[2] = t_far;
    row[3] = as_float(octant);
    row[4] = hn::Zero(k8);
    row[5] = as_float(hn::Iota(u8, first));
    row[6] = row[7] = hn::Zero(k8);
    put(32);
    // The longest axis; of equal ones the smaller.
    const M8 z_is_x = hn::And(hn::Ge(size[0], size[1]), hn::Ge(size[0], size[2]));
    const M8 z_is_y = hn::And(hn::Lt(size[0], size[1]), hn::Ge(size[1], size[2]));
    const auto pick = [&](const V8(&v)[3], int next) HWY_ATTR {
        return hn::IfThenElse(z_is_x, v[next],
                              hn::IfThenElse(z_is_y, v[(next + 1) % 3], v[(next + 2) % 3]));
    };
    const V8 dz = pick(d, 0);
    row[0] = pick(o, 1);
    row[1] = pick(o, 2);
    row[2] = pick(o, 0);
    row[3] = hn::Div(pick(d, 1), dz);
    row[4] = hn::Div(pick(d, 2), dz);
    const V8 limit = hn::Add(distance, distance), dz_abs = hn::Abs(dz);
    row[5] = hn::Max(hn::Mul(t_min, dz_abs), hn::Neg(limit));
    row[6] = hn::Min(hn::Mul(t_max, dz_abs), limit);
    row[7] = hn::CopySign(hn::Mul(hn::Set(k8, 32.0f), distance), dz);
    put(64);
    const auto axes =
        hn::IfThenElse(hn::RebindMask(u8, z_is_x), hn::Set(u8, 0x00000804u),
                       hn::IfThenElse(hn::RebindMask(u8, z_is_y), hn::Set(u8, 0x00040008u),
                                      hn::Set(u8, 0x00080400u)));
    row[0] = as_float(axes);
    row[1] = dz;
    row[2] = t_min;
    row[3] = t_max;
    row[4] = as_float(hn::Set(u8, geometry::kNoTriangle));
    row[5] = row[6] = row[7] = hn::Zero(k8);
    put(96);
    return {bits_of(k8, alive) & there, ~bits_of(k8, fits) & there};
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
