// Rays with a common origin as one beam. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/lanes-inl.h"
#include "trace/kernels.h"
#include "trace/slabs.h"

#include <algorithm>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

inline constexpr uint32_t kGroupRays = 16;
inline constexpr uint32_t kGroups = 16; // bits of a uint32_t tell which ones
inline constexpr uint32_t kBeamRays = kGroups * kGroupRays;
inline constexpr uint32_t kAllGroups = (1u << kGroups) - 1;

// Slopes of directions: those of the two lesser axes over that of the main axis.
struct Window {
    float p0, p1, q0, q1;
};

// Coordinates along the three axes: p and q across the beam, z along it and positive ahead. A ray
// is the points (p z, q z, z), so z is also what hits are ordered by.
struct Beam {
    int kx, ky, kz;
    float sign;      // of the directions along kz
    float origin[3]; // along kx, ky, kz
    float margin;    // what boxes are widened by
    float near;      // z where the first ray begins
    float center_p, center_q;
    uint32_t first, count; // rays of the stream
    uint32_t groups;       // bits

    alignas(64) float p[kBeamRays], q[kBeamRays];
    alignas(64) float from_center_p[kBeamRays], from_center_q[kBeamRays];
    alignas(64) float scale[kBeamRays]; // |direction| along kz: z = t scale
    alignas(64) float limit[kBeamRays]; // z that a hit must not exceed; negative: no more hits
    uint32_t foreign[kGroups]; // bits of a group's rays with another main axis of their own

    Window window;
    alignas(64) float group_p0[kGroups], group_p1[kGroups]; // windows from the centre
    alignas(64) float group_q0[kGroups], group_q1[kGroups];
    alignas(64) float group_limit[kGroups]; // the largest limit of its rays

    // False if these rays do not make a beam: then nothing may be concluded from it.
    HWY_ATTR bool gather(const Target& target, const RayStream& rays, uint32_t begin, uint32_t n);

    HWY_INLINE HWY_ATTR void update_limit(uint32_t group) {
        const float* limits = limit + group * kGroupRays;
        V8 largest = hn::Load(k8, limits);
        for (size_t i = kLanes8; i < kGroupRays; i += kLanes8)
            largest = hn::Max(largest, hn::Load(k8, limits + i));
        group_limit[group] = hn::GetLane(hn::MaxOfLanes(k8, largest));
    }

    // Groups of `mask` that can still be hit at z or beyond.
    HWY_INLINE HWY_ATTR uint32_t reaching(uint32_t mask, float z) const {
        uint32_t bits = 0;
        for (uint32_t g = 0; g < kGroups; g += kLanes8)
            bits |= bits_of(k8, hn::Ge(hn::Load(k8, group_limit + g), hn::Set(k8, z))) << g;
        return bits & mask;
    }

    // The largest limit of groups in `mask`.
    HWY_INLINE HWY_ATTR float limit_of(uint32_t mask) const {
        float largest = -1;
        for (; mask; mask &= mask - 1)
            largest = std::max(largest, group_limit[__builtin_ctz(mask)]);
        return largest;
    }

    // The union of the groups' windows.
    HWY_INLINE HWY_ATTR Window window_of(uint32_t mask) const {
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        Window w{kInfinity, -kInfinity, kInfinity, -kInfinity};
        for (; mask; mask &= mask - 1) {
            const int g = __builtin_ctz(mask);
            w.p0 = std::min(w.p0, group_p0[g]);
            w.p1 = std::max(w.p1, group_p1[g]);
            w.q0 = std::min(w.q0, group_q0[g]);
            w.q1 = std::max(w.q1, group_q1[g]);
        }
        return w;
    }
};

inline HWY_ATTR bool Beam::gather(const Target& target, const RayStream& rays, uint32_t begin,
                                  uint32_t n) {
    // Canonical rays and these agree on the sign of an edge function but near 0 up to this slope:
    // see Facet.
    constexpr float kMaxSlope = 1.125f;
    first = begin;
    count = n;
    const uint32_t middle = begin + n / 2;
    const math::Ray ray = ray_at(rays, middle);
    const math::Vec3 along = glm::abs(ray.direction);
    kz = along.x >= along.y ? (along.x >= along.z ? 0 : 2) : (along.y >= along.z ? 1 : 2);
    kx = kz == 2 ? 0 : kz + 1;
    ky = kx == 2 ? 0 : kx + 1;
    sign = ray.direction[kz] < 0 ? -1.0f : 1.0f;
    origin[0] = ray.origin[kx];
    origin[1] = ray.origin[ky];
    origin[2] = ray.origin[kz];
    const float distance = reach<float>(target.bounds, ray.origin);
    if (!fits_float(1, distance)) return false;
    const float far_away = largest_component(ray.origin);
    margin = 0x1p-20f * distance + 0x1p-22f * far_away;

    const uint32_t group_count = (n + kGroupRays - 1) / kGroupRays;
    groups = (1u << group_count) - 1;
    const V8 one = hn::Set(k8, 1.0f);
    const V8 sign_v = hn::Set(k8, sign);
    V8 steepest = hn::Zero(k8), least_scale = hn::Set(k8, 0x1p32f), most_scale = hn::Zero(k8);
    V8 nearest = hn::Set(k8, std::numeric_limits<float>::infinity());
    M8 same_origin = hn::FirstN(k8, kLanes8);
    V8 least_p = nearest, least_q = nearest, most_p = hn::Neg(nearest), most_q = hn::Neg(nearest);
    for (uint32_t g = 0; g < group_count; ++g) {
        V8 p0 = hn::Set(k8, std::numeric_limits<float>::infinity()), q0 = p0;
        V8 p1 = hn::Neg(p0), q1 = p1;
        foreign[g] = 0;
        for (uint32_t i = g * kGroupRays; i < (g + 1) * kGroupRays; i += kLanes8) {
            // Places beyond the last ray repeat the middle one, without ever being hit.
            const M8 there = hn::FirstN(k8, i < n ? n - i : 0);
            const auto load = [&](const float* array) HWY_ATTR {
                return hn::IfThenElse(there, hn::LoadU(k8, array + begin + i),
                                      hn::Set(k8, array[middle]));
            };
            const V8 dz = load(rays.direction[kz]);
            const V8 scale_v = hn::Mul(dz, sign_v);
            const V8 p_v = hn::Div(load(rays.direction[kx]), scale_v);
            const V8 q_v = hn::Div(load(rays.direction[ky]), scale_v);
            for (int k = 0; k < 3; ++k)
                same_origin =
                    hn::And(same_origin, hn::Eq(load(rays.origin[k]), hn::Set(k8, ray.origin[k])));
            const V8 slope = hn::Max(hn::Abs(p_v), hn::Abs(q_v));
            steepest = hn::Max(steepest, slope);
            least_scale = hn::Min(least_scale, scale_v);
            most_scale = hn::Max(most_scale, scale_v);
            nearest = hn::Min(nearest, load(rays.t_min));
            p0 = hn::Min(p0, p_v);
            p1 = hn::Max(p1, p_v);
            q0 = hn::Min(q0, q_v);
            q1 = hn::Max(q1, q_v);
            // The rule of geometry::shear: of equal ones the smaller axis.
            foreign[g] |= bits_of(k8, hn::Ge(slope, one)) << (i % kGroupRays);
            hn::Store(p_v, k8, p + i);
            hn::Store(q_v, k8, q + i);
            hn::Store(scale_v, k8, scale + i);
            const V8 end = hn::Mul(load(rays.t_max), scale_v);
            hn::Store(hn::IfThenElse(there, end, hn::Set(k8, -1.0f)), k8, limit + i);
        }
        group_p0[g] = hn::GetLane(hn::MinOfLanes(k8, p0));
        group_p1[g] = hn::GetLane(hn::MaxOfLanes(k8, p1));
        group_q0[g] = hn::GetLane(hn::MinOfLanes(k8, q0));
        group_q1[g] = hn::GetLane(hn::MaxOfLanes(k8, q1));
        least_p = hn::Min(least_p, p0);
        most_p = hn::Max(most_p, p1);
        least_q = hn::Min(least_q, q0);
        most_q = hn::Max(most_q, q1);
        update_limit(g);
    }
    const float least = hn::GetLane(hn::MinOfLanes(k8, nearest));
    if (!hn::AllTrue(k8, same_origin)) return false;
    if (!(hn::GetLane(hn::MaxOfLanes(k8, steepest)) <= kMaxSlope)) return false;
    if (!(hn::GetLane(hn::MinOfLanes(k8, least_scale)) >= 0x1p-32f)) return false;
    if (!(hn::GetLane(hn::MaxOfLanes(k8, most_scale)) <= 0x1p32f)) return false;
    if (!(least >= 0)) return false;
    near = least * hn::GetLane(hn::MinOfLanes(k8, least_scale));
    window = {hn::GetLane(hn::MinOfLanes(k8, least_p)), hn::GetLane(hn::MaxOfLanes(k8, most_p)),
              hn::GetLane(hn::MinOfLanes(k8, least_q)), hn::GetLane(hn::MaxOfLanes(k8, most_q))};
    center_p = 0.5f * (window.p0 + window.p1);
    center_q = 0.5f * (window.q0 + window.q1);
    window = {window.p0 - center_p, window.p1 - center_p, window.q0 - center_q,
              window.q1 - center_q};
    const V8 cp = hn::Set(k8, center_p), cq = hn::Set(k8, center_q);
    for (uint32_t i = 0; i < group_count * kGroupRays; i += kLanes8) {
        hn::Store(hn::Sub(hn::Load(k8, p + i), cp), k8, from_center_p + i);
        hn::Store(hn::Sub(hn::Load(k8, q + i), cq), k8, from_center_q + i);
    }
    for (uint32_t g = group_count; g < kGroups; ++g) {
        group_p0[g] = group_p1[g] = center_p;
        group_q0[g] = group_q1[g] = center_q;
        group_limit[g] = -1;
    }
    for (uint32_t g = 0; g < kGroups; g += kLanes8)
        for (float* slopes : {group_p0, group_p1})
            hn::Store(hn::Sub(hn::Load(k8, slopes + g), cp), k8, slopes + g);
    for (uint32_t g = 0; g < kGroups; g += kLanes8)
        for (float* slopes : {group_q0, group_q1})
            hn::Store(hn::Sub(hn::Load(k8, slopes + g), cq), k8, slopes + g);
    return true;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
