// Many rays of which each is a point of a plane, in groups, and triangles as they see them.
// Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_GROUPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_GROUPS_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_GROUPS_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_GROUPS_INL_H
#endif

#include <hwy/highway.h>

#include "simd/lanes-inl.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

inline constexpr uint32_t kGroupRays = 32;
inline constexpr uint32_t kGroups = 16; // bits of a uint32_t tell which ones
inline constexpr uint32_t kBeamRays = kGroups * kGroupRays;
inline constexpr uint32_t kAllRays = uint32_t((uint64_t(1) << kGroupRays) - 1); // of a group

// The limit of rays that want no more hits.
constexpr float kNever = -std::numeric_limits<float>::infinity();

// A part of the plane of p and q.
struct Window {
    float p0, p1, q0, q1;
};

// What Beam and ParallelBeam have in common: a ray is a point (p, q), and z is what hits are
// ordered by. What p, q and z are is theirs.
struct RayGroups {
    float near;            // z where the first ray begins, ...
    float last_begin;      // ... and the last
    uint32_t first, count; // rays of the stream
    uint32_t groups;       // bits
    uint32_t endless;      // bits of groups of which no ray has an end or a hit yet

    alignas(64) float p[kBeamRays], q[kBeamRays];
    alignas(64) float limit[kBeamRays]; // z that a hit must not exceed

    Window window;
    alignas(64) float group_p0[kGroups], group_p1[kGroups];
    alignas(64) float group_q0[kGroups], group_q1[kGroups];
    alignas(64) float group_limit[kGroups]; // the largest limit of its rays

    HWY_INLINE HWY_ATTR void update_limit(uint32_t group) {
        const float* limits = limit + group * kGroupRays;
        V8 largest = hn::Load(k8, limits);
        for (size_t i = kLanes8; i < kGroupRays; i += kLanes8)
            largest = hn::Max(largest, hn::Load(k8, limits + i));
        group_limit[group] = hn::GetLane(hn::MaxOfLanes(k8, largest));
        endless &= ~(1u << group);
    }

    // Groups of `mask` that can still be hit at z or beyond.
    HWY_INLINE HWY_ATTR uint32_t reaching(uint32_t mask, float z) const {
        uint32_t bits = 0;
        for (uint32_t g = 0; g < kGroups; g += kLanes8)
            bits |= bits_of(k8, hn::Ge(hn::Load(k8, group_limit + g), hn::Set(k8, z))) << g;
        return bits & mask;
    }

    // The largest limit of groups in `mask`, and the union of their windows.
    HWY_INLINE HWY_ATTR float limit_of(uint32_t mask) const {
        return -least_of(mask, group_limit, true);
    }
    HWY_INLINE HWY_ATTR Window window_of(uint32_t mask) const {
        return {least_of(mask, group_p0, false), -least_of(mask, group_p1, true),
                least_of(mask, group_q0, false), -least_of(mask, group_q1, true)};
    }

    // The groups of `mask` that have such rays.
    HWY_INLINE HWY_ATTR uint32_t groups_in(uint32_t mask, const Window& in, float z) const {
        uint32_t found = 0;
        for (; mask; mask &= mask - 1) {
            const uint32_t group = uint32_t(__builtin_ctz(mask));
            if (find_rays(group, in, z)) found |= 1u << group;
        }
        return found;
    }

    // Groups beyond the last one that has rays are like the first, but never hit.
    void fill_groups() {
        for (uint32_t g = uint32_t(__builtin_popcount(groups)); g < kGroups; ++g) {
            group_p0[g] = group_p1[g] = group_p0[0];
            group_q0[g] = group_q1[g] = group_q0[0];
            group_limit[g] = kNever;
        }
    }

    // Rays of a group that lie in a window and whose limit is beyond z.
    HWY_INLINE HWY_ATTR uint32_t find_rays(uint32_t group, const Window& in, float z) const {
        const V8 p0 = hn::Set(k8, in.p0), p1 = hn::Set(k8, in.p1);
        const V8 q0 = hn::Set(k8, in.q0), q1 = hn::Set(k8, in.q1);
        uint32_t rays = 0;
        for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
            const uint32_t at = group * kGroupRays + i;
            const V8 x = hn::Load(k8, p + at), y = hn::Load(k8, q + at);
            const auto inside = hn::And(hn::And(hn::Ge(x, p0), hn::Le(x, p1)),
                                        hn::And(hn::Ge(y, q0), hn::Le(y, q1)));
            const auto open = hn::Ge(hn::Load(k8, limit + at), hn::Set(k8, z));
            rays |= bits_of(k8, hn::And(inside, open)) << i;
        }
        return rays;
    }

private:
    HWY_INLINE HWY_ATTR float least_of(uint32_t mask, const float* values, bool negated) const {
        const V8 infinity = hn::Set(k8, std::numeric_limits<float>::infinity());
        V8 least = infinity;
        for (uint32_t g = 0; g < kGroups; g += kLanes8) {
            const V8 value = hn::Load(k8, values + g);
            least = hn::Min(least, hn::IfThenElse(mask_of(mask >> g),
                                                  negated ? hn::Neg(value) : value, infinity));
        }
        return hn::GetLane(hn::MinOfLanes(k8, least));
    }
};

// What the rays of a beam or a group have in common. Lanes are different rays until reduce().
struct Extent {
    V8 p0, minus_p1, q0, minus_q1;

    HWY_ATTR Extent() {
        p0 = minus_p1 = q0 = minus_q1 = hn::Set(k8, std::numeric_limits<float>::infinity());
    }
    HWY_INLINE HWY_ATTR void add(V8 p, V8 q) {
        p0 = hn::Min(p0, p);
        q0 = hn::Min(q0, q);
        minus_p1 = hn::Min(minus_p1, hn::Neg(p));
        minus_q1 = hn::Min(minus_q1, hn::Neg(q));
    }
    // p0, q0, -p1, -q1.
    HWY_INLINE HWY_ATTR V4 reduce() const {
        const V8 pq0 = hn::Min(hn::InterleaveLower(k8, p0, q0), hn::InterleaveUpper(k8, p0, q0));
        const V8 pq1 = hn::Min(hn::InterleaveLower(k8, minus_p1, minus_q1),
                               hn::InterleaveUpper(k8, minus_p1, minus_q1));
        const hn::Repartition<double, D8> pairs;
        const auto a = hn::BitCast(pairs, pq0), b = hn::BitCast(pairs, pq1);
        const V8 all = hn::Min(hn::BitCast(k8, hn::InterleaveLower(pairs, a, b)),
                               hn::BitCast(k8, hn::InterleaveUpper(pairs, a, b)));
        return least_of_halves(all);
    }
};

// Four triangles in the plane of p and q, where their edges are lines.
struct Facets {
    // By edge and triangle: a p + b q + c. Those seen from behind have their signs turned: rays
    // inside are where all three are positive.
    alignas(16) float a[3][4], b[3][4], c[3][4];
    alignas(16) float tolerance[4];
    // What depth is judged by, and its range for a hit: the limit's own rounding is counted.
    alignas(16) float plane_a[4], plane_b[4], plane_c[4];
    alignas(16) float least_h[4], most_h[4];
    alignas(16) float nearest[4];                 // no hit has a smaller z
    alignas(16) float p0[4], p1[4], q0[4], q1[4]; // windows
    uint32_t by_window;                           // bits: of uncertain orientation
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
