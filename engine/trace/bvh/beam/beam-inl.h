// Rays with a common origin as one beam. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_BEAM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_BEAM_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_BEAM_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_BEAM_INL_H
#endif

#include <hwy/highway.h>

#include "geometry/intersect.h"
#include "simd/lanes-inl.h"
#include "trace/bvh/beam/groups-inl.h"
#include "trace/kernels.h"
#include "trace/slabs.h"

#include <algorithm>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Up to this slope the edge functions of Facets and of the canonical test agree.
constexpr float kMaxSlope = 1.125f;

struct BeamChildren;
struct BeamFacets;

// Coordinates along the three axes: p and q across the beam, z along it and positive ahead. A ray
// is the points (p z, q z, z): p and q are slopes, those of the two lesser axes over that of the
// main axis, less those of the centre.
struct Beam : RayGroups {
    using Children = BeamChildren;
    using SeenFacets = BeamFacets;
    // How OccludedBeam goes through the tree. Measured.
    struct Shadows {
        static constexpr float kTinySide = 0.3f;
        static constexpr bool kLooksForRays = false;
        static uint32_t most_tiny(uint32_t rays) { return rays / 3; }
        static uint32_t most_nodes(uint32_t) { return ~0u; }
    };

    int kx, ky, kz;
    float sign;      // of the directions along kz
    float origin[3]; // along kx, ky, kz
    float margin;    // what boxes are widened by
    float center_p, center_q;

    // sx and sy of geometry::shear for rays whose main axis is kz.
    alignas(64) float sx[kBeamRays], sy[kBeamRays];
    uint32_t foreign[kGroups]; // bits of a group's rays with another main axis

    // False if these rays do not make a beam: then nothing may be concluded from it.
    HWY_ATTR bool gather(const Target& target, const RayStream& rays, uint32_t begin, uint32_t n);

    // What tells how the plane of a facet, with these coefficients, lies to the ends of rays.
    static HWY_INLINE HWY_ATTR V8 height(V8 limit, V8 p, V8 q, V8 a, V8 b, V8 c) {
        return hn::Mul(limit, hn::MulAdd(p, a, hn::MulAdd(q, b, c)));
    }

private:
    template <bool Full>
    HWY_ATTR bool gather_rays(const RayStream& rays);
    HWY_ATTR void center();
};

template <bool Full>
HWY_ATTR bool Beam::gather_rays(const RayStream& rays) {
    const uint32_t middle = first + count / 2;
    const V8 one = hn::Set(k8, 1.0f);
    const V8 sign_v = hn::Set(k8, sign);
    const V8 ox = hn::Set(k8, rays.origin[0][middle]), oy = hn::Set(k8, rays.origin[1][middle]),
             oz = hn::Set(k8, rays.origin[2][middle]);
    V8 steepest = hn::Zero(k8), least_scale = hn::Set(k8, 0x1p32f), most_scale = hn::Zero(k8);
    V8 begin = hn::Set(k8, std::numeric_limits<float>::infinity());
    V8 last = hn::Zero(k8);
    V8 apart = hn::Zero(k8);
    const uint32_t group_count = (count + kGroupRays - 1) / kGroupRays;
    endless = 0;
    for (uint32_t g = 0; g < group_count; ++g) {
        Extent extent;
        uint32_t steep = 0;
        V8 farthest = hn::Set(k8, kNever);
        V8 soonest = hn::Set(k8, std::numeric_limits<float>::infinity());
        for (uint32_t i = g * kGroupRays; i < (g + 1) * kGroupRays; i += kLanes8) {
            // Places beyond the last ray repeat the middle one, without ever being hit.
            const M8 there = hn::FirstN(k8, Full ? kLanes8 : i < count ? count - i : 0);
            const auto load = [&](const float* array) HWY_ATTR {
                if (Full) return hn::LoadU(k8, array + first + i);
                const V8 stand_in = hn::Set(k8, array[middle]);
                return i < count ? hn::IfThenElse(there, hn::LoadU(k8, array + first + i), stand_in)
                                 : stand_in;
            };
            apart = hn::Or(apart, hn::Or(hn::Xor(load(rays.origin[0]), ox),
                                         hn::Or(hn::Xor(load(rays.origin[1]), oy),
                                                hn::Xor(load(rays.origin[2]), oz))));
            const V8 dz = load(rays.direction[kz]);
            const V8 x = hn::Div(load(rays.direction[kx]), dz);
            const V8 y = hn::Div(load(rays.direction[ky]), dz);
            hn::Store(x, k8, sx + i);
            hn::Store(y, k8, sy + i);
            const V8 slope_p = hn::Mul(x, sign_v), slope_q = hn::Mul(y, sign_v);
            hn::Store(slope_p, k8, p + i);
            hn::Store(slope_q, k8, q + i);
            extent.add(slope_p, slope_q);
            const V8 slope = hn::Max(hn::Abs(x), hn::Abs(y));
            steepest = hn::Max(steepest, slope);
            // The rule of geometry::shear; where two axes tie, either may be the main one.
            steep |= bits_of(k8, hn::Ge(slope, one)) << (i % kGroupRays);
            const V8 scale = hn::Mul(dz, sign_v);
            least_scale = hn::Min(least_scale, scale);
            most_scale = hn::Max(most_scale, scale);
            const V8 t_min = load(rays.t_min);
            begin = hn::Min(begin, t_min);
            last = hn::Max(last, hn::Mul(t_min, scale));
            V8 end = hn::Mul(load(rays.t_max), scale);
            if (!Full) end = hn::IfThenElse(there, end, hn::Set(k8, kNever));
            hn::Store(end, k8, limit + i);
            farthest = hn::Max(farthest, end);
            soonest = hn::Min(soonest, end);
        }
        foreign[g] = steep;
        const bool no_end =
            hn::AllTrue(k8, hn::Eq(soonest, hn::Set(k8, std::numeric_limits<float>::infinity())));
        endless |= uint32_t(no_end) << g;
        alignas(16) float reduced[4];
        hn::Store(extent.reduce(), k4, reduced);
        group_p0[g] = reduced[0];
        group_q0[g] = reduced[1];
        group_p1[g] = -reduced[2];
        group_q1[g] = -reduced[3];
        group_limit[g] = hn::GetLane(hn::MaxOfLanes(k8, farthest));
    }
    const hn::RebindToUnsigned<D8> u8;
    if (!hn::AllTrue(u8, hn::Eq(hn::BitCast(u8, apart), hn::Zero(u8)))) return false;
    const float least = hn::GetLane(hn::MinOfLanes(k8, least_scale));
    if (!(hn::GetLane(hn::MaxOfLanes(k8, steepest)) <= kMaxSlope && least >= 0x1p-32f
          && hn::GetLane(hn::MaxOfLanes(k8, most_scale)) <= 0x1p32f))
        return false;
    near = hn::GetLane(hn::MinOfLanes(k8, begin)) * least;
    last_begin = hn::GetLane(hn::MaxOfLanes(k8, last)) * (1.0f + 0x1p-20f);
    groups = (1u << group_count) - 1;
    return near >= 0;
}

// From slopes to slopes less those of the centre.
inline HWY_ATTR void Beam::center() {
    fill_groups();
    window = window_of(groups);
    center_p = 0.5f * (window.p0 + window.p1);
    center_q = 0.5f * (window.q0 + window.q1);
    window = {window.p0 - center_p, window.p1 - center_p, window.q0 - center_q,
              window.q1 - center_q};
    const V8 cp = hn::Set(k8, center_p), cq = hn::Set(k8, center_q);
    const auto subtract = [](float* values, uint32_t n, V8 c) HWY_ATTR {
        for (uint32_t i = 0; i < n; i += kLanes8)
            hn::Store(hn::Sub(hn::Load(k8, values + i), c), k8, values + i);
    };
    const uint32_t padded = uint32_t(__builtin_popcount(groups)) * kGroupRays;
    subtract(p, padded, cp);
    subtract(q, padded, cq);
    subtract(group_p0, kGroups, cp);
    subtract(group_p1, kGroups, cp);
    subtract(group_q0, kGroups, cq);
    subtract(group_q1, kGroups, cq);
}

inline HWY_ATTR bool Beam::gather(const Target& target, const RayStream& rays, uint32_t begin,
                                  uint32_t n) {
    first = begin;
    count = n;
    const math::Ray ray = ray_at(rays, begin + n / 2);
    const geometry::Axes axes = geometry::axes_of(ray.direction);
    kx = axes.kx, ky = axes.ky, kz = axes.kz;
    sign = ray.direction[kz] < 0 ? -1.0f : 1.0f;
    origin[0] = ray.origin[kx];
    origin[1] = ray.origin[ky];
    origin[2] = ray.origin[kz];
    const float distance = reach<float>(target.bounds, ray.origin);
    if (!fits_float(1, distance)) return false;
    margin = 0x1p-20f * distance + 0x1p-22f * largest_component(ray.origin);
    if (!(n % kGroupRays == 0 ? gather_rays<true>(rays) : gather_rays<false>(rays))) return false;
    center();
    return true;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
