// Rays with one direction as a beam. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_PARALLEL_PARALLEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_PARALLEL_PARALLEL_INL_H
#undef PEREGRINE_TRACE_BVH_PARALLEL_PARALLEL_INL_H
#else
#define PEREGRINE_TRACE_BVH_PARALLEL_PARALLEL_INL_H
#endif

#include <hwy/highway.h>

#include "geometry/intersect.h"
#include "simd/lanes-inl.h"
#include "trace/bvh/beam/groups-inl.h"
#include "trace/kernels.h"
#include "trace/slabs.h"

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

struct ParallelChildren;
struct ParallelFacets;

// A beam whose rays meet at infinity, where z is lowest: rays go down from where they begin, as if
// they came from a sun, and end at their limits. The axes are sheared along the direction as
// geometry/intersect.h does it: relative to the centre a point (x, y, z) of the scene is
//     (x - sx z, y - sy z, z),
// with the signs of z turned where directions are positive. There a ray is a point (p, q), its
// foot, a triangle's edges are lines, and so is what its plane adds to z.
//
// Errors are in units of e = 2^-24. Dv is the largest distance of a vertex (of anything, for boxes)
// from the centre along an axis, Do that of a ray's beginning, which counts t_min, D = Dv + Do: all
// of the canonical test's distances are below. A point is off by 5 Dv across, rounding of its place
// being Dv + |sx| Dv and of the shear 3 Dv; a foot is off by 5 Do. A hit is within 8.1 D of a point
// P of the triangle (the theorem of geometry/intersect.h), so P is within (1 + |sx|) 8.1 D of the
// foot, and 1.1 D for the rounding of sx: 17.3 D. What is computed of both is closer than 17.3 D +
// 5 Dv + 5 Do = 22.3 D, across. Along it, P is closer to the hit than 8.1 D, and z is rounded by
// Dv; a limit is off by 4 Do. Windows and boxes are widened by
//     margin = 2^-19 D,
// which is 32, and leaves 9 for adding it.
struct ParallelBeam : RayGroups {
    using Children = ParallelChildren;
    using SeenFacets = ParallelFacets;
    struct Shadows { // see Beam
        static constexpr float kTinySide = 0.5f;
        static constexpr bool kLooksForRays = true;
        static uint32_t most_tiny(uint32_t) { return ~0u; }
        static uint32_t most_nodes(uint32_t rays) { return 32 + rays / 4; }
    };

    int kx, ky, kz;
    float turn;      // -1 where directions along kz are positive
    float sx, sy;    // of geometry::shear
    float center[3]; // along kx, ky, kz
    float reach;     // Do
    float margin;    // of boxes

    // False if these rays do not make such a beam: then nothing may be concluded from it.
    HWY_ATTR bool gather(const Target& target, const RayStream& rays, uint32_t begin, uint32_t n);

    // How far the plane of a facet lies beyond the ends of rays, but for a constant.
    static HWY_INLINE HWY_ATTR V8 height(V8 limit, V8 p, V8 q, V8 a, V8 b, V8) {
        return hn::MulAdd(p, a, hn::MulAdd(q, b, limit));
    }

private:
    HWY_ATTR bool measure(const RayStream& rays);
    bool is_narrow(float distance) const;
    template <bool Full>
    HWY_ATTR void gather_rays(const RayStream& rays);
};

// Whether all directions have the same bits. Finds the centre, `reach`, and the range of z where
// rays begin.
inline HWY_ATTR bool ParallelBeam::measure(const RayStream& rays) {
    const hn::RebindToUnsigned<D8> u8;
    V8 apart = hn::Zero(k8);
    for (const float* direction : rays.direction) {
        const V8 first_one = hn::Set(k8, direction[first]);
        for (uint32_t i = 0; i < count; i += kLanes8) {
            const M8 there = hn::FirstN(k8, count - i);
            const V8 other = hn::Xor(hn::LoadU(k8, direction + first + i), first_one);
            apart = hn::Or(apart, hn::IfThenElseZero(there, other));
        }
    }
    if (!hn::AllTrue(u8, hn::Eq(hn::BitCast(u8, apart), hn::Zero(u8)))) return false;

    const float scale = std::fabs(rays.direction[kz][first]);
    if (!(scale >= 0x1p-32f && scale <= 0x1p32f && std::max(std::fabs(sx), std::fabs(sy)) <= 1))
        return false;
    const int axes[3] = {kx, ky, kz};
    reach = 0;
    const auto range = [&](const float* values, float& least, float& most) HWY_ATTR {
        V8 low = hn::Set(k8, values[first]), high = low;
        for (uint32_t i = 0; i < count; i += kLanes8) {
            const V8 value =
                hn::IfThenElse(hn::FirstN(k8, count - i), hn::LoadU(k8, values + first + i), low);
            low = hn::Min(low, value);
            high = hn::Max(high, value);
        }
        least = hn::GetLane(hn::MinOfLanes(k8, low));
        most = hn::GetLane(hn::MaxOfLanes(k8, high));
    };
    for (int k = 0; k < 3; ++k) {
        float least, most;
        range(rays.origin[axes[k]], least, most);
        if (!(most - least < 0x1p60f)) return false;
        center[k] = 0.5f * least + 0.5f * most;
        reach = std::max(reach, std::max(center[k] - least, most - center[k]));
    }
    float least, most;
    range(rays.t_min, least, most);
    const float depth = reach;
    reach += scale * std::max(std::fabs(least), std::fabs(most));
    range(rays.t_max, least, most);
    // Of z at the far ends: 4 (Do + |z|) are its rounding.
    const auto end = [&](float t, float part) { return part * depth - t * scale; };
    near = end(most, -1);
    near -= 0x1p-20f * (reach + std::fabs(near));
    last_begin = end(least, 1);
    last_begin = last_begin < 0 ? last_begin * (1 - 0x1p-20f) : last_begin * (1 + 0x1p-20f);
    last_begin += 0x1p-20f * reach;
    return true;
}

template <bool Full>
HWY_ATTR void ParallelBeam::gather_rays(const RayStream& rays) {
    const V8 cx = hn::Set(k8, center[0]), cy = hn::Set(k8, center[1]), cz = hn::Set(k8, center[2]);
    const V8 slope_x = hn::Set(k8, sx), slope_y = hn::Set(k8, sy), turn_v = hn::Set(k8, turn);
    const V8 scale = hn::Set(k8, std::fabs(rays.direction[kz][first]));
    const uint32_t group_count = (count + kGroupRays - 1) / kGroupRays;
    for (uint32_t g = 0; g < group_count; ++g) {
        Extent extent;
        V8 farthest = hn::Set(k8, kNever);
        for (uint32_t i = g * kGroupRays; i < (g + 1) * kGroupRays; i += kLanes8) {
            // Places beyond the last ray repeat the first one, without ever being hit.
            const M8 there = hn::FirstN(k8, Full ? kLanes8 : i < count ? count - i : 0);
            const auto load = [&](const float* array) HWY_ATTR {
                if (Full) return hn::LoadU(k8, array + first + i);
                const V8 stand_in = hn::Set(k8, array[first]);
                return i < count ? hn::IfThenElse(there, hn::LoadU(k8, array + first + i), stand_in)
                                 : stand_in;
            };
            const V8 z = hn::Sub(load(rays.origin[kz]), cz);
            const V8 x = hn::NegMulAdd(slope_x, z, hn::Sub(load(rays.origin[kx]), cx));
            const V8 y = hn::NegMulAdd(slope_y, z, hn::Sub(load(rays.origin[ky]), cy));
            hn::Store(x, k8, p + i);
            hn::Store(y, k8, q + i);
            extent.add(x, y);
            V8 end = hn::NegMulAdd(load(rays.t_min), scale, hn::Mul(z, turn_v));
            if (!Full) end = hn::IfThenElse(there, end, hn::Set(k8, kNever));
            hn::Store(end, k8, limit + i);
            farthest = hn::Max(farthest, end);
        }
        alignas(16) float reduced[4];
        hn::Store(extent.reduce(), k4, reduced);
        group_p0[g] = reduced[0];
        group_q0[g] = reduced[1];
        group_p1[g] = -reduced[2];
        group_q1[g] = -reduced[3];
        group_limit[g] = hn::GetLane(hn::MaxOfLanes(k8, farthest));
    }
    groups = (1u << group_count) - 1;
}

// By the mean width of a group by its length; measured: beyond, waves are faster.
inline bool ParallelBeam::is_narrow(float distance) const {
    constexpr float kWidest = 0.15f;
    float width = 0, length = 0;
    for (uint32_t g = 0; groups >> g & 1; ++g) {
        width += (group_p1[g] - group_p0[g]) + (group_q1[g] - group_q0[g]);
        length += std::clamp(group_limit[g] - near, 0.0f, distance);
    }
    return width <= kWidest * length;
}

inline HWY_ATTR bool ParallelBeam::gather(const Target& target, const RayStream& rays,
                                          uint32_t begin, uint32_t n) {
    first = begin;
    count = n;
    endless = 0;
    const math::Vec3 direction = ray_at(rays, begin).direction;
    const geometry::Axes axes = geometry::axes_of(direction);
    kx = axes.kx, ky = axes.ky, kz = axes.kz;
    turn = direction[kz] < 0 ? 1.0f : -1.0f;
    sx = direction[kx] / direction[kz];
    sy = direction[ky] / direction[kz];
    if (!measure(rays)) return false;
    math::Vec3 middle;
    middle[kx] = center[0], middle[ky] = center[1], middle[kz] = center[2];
    const float distance = trace::reach<float>(target.bounds, middle) + reach;
    if (!fits_float(1, distance)) return false;
    margin = 0x1p-19f * distance;
    if (n % kGroupRays == 0)
        gather_rays<true>(rays);
    else
        gather_rays<false>(rays);
    fill_groups();
    window = window_of(groups);
    return is_narrow(distance);
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
