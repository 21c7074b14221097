// Rays that are alike without a common origin, as one pencil. Included once for each instruction
// set.
#if defined(PEREGRINE_TRACE_BVH_PENCIL_PENCIL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_PENCIL_PENCIL_INL_H
#undef PEREGRINE_TRACE_BVH_PENCIL_PENCIL_INL_H
#else
#define PEREGRINE_TRACE_BVH_PENCIL_PENCIL_INL_H
#endif

#include <hwy/highway.h>

#include "geometry/intersect.h"
#include "simd/lanes-inl.h"
#include "trace/bvh/beam/beam-inl.h"
#include "trace/kernels.h"
#include "trace/slabs.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

inline constexpr uint32_t kBundleRays = 8; // a bundle is what leaves are tested with
inline constexpr uint32_t kBundles = 32;   // bits of a uint32_t tell which ones
inline constexpr uint32_t kPencilRays = kBundles * kBundleRays;

// Rays as lines over the main axis: z counts from a plane behind all origins, ahead is positive,
// and a ray is the points (a + p z, b + q z, z). What a bundle's rays have in common are intervals.
struct Pencil {
    int kx, ky, kz;
    float sign;    // of the directions along kz
    float plane_z; // where z is 0
    float margin;  // what boxes are widened by
    float near;    // z where the first ray begins
    uint32_t first, count;
    uint32_t bundles; // bits

    alignas(64) float sx[kPencilRays], sy[kPencilRays]; // as geometry::shear has them
    alignas(64) float limit[kPencilRays]; // z that a hit must not exceed; negative: no more hits
    uint8_t foreign[kBundles];            // bits of a bundle's rays with another main axis

    // By bundle, and at place kBundles of all: least and largest a, p, b, q.
    alignas(64) float a0[kBundles + 1], a1[kBundles + 1], p0[kBundles + 1], p1[kBundles + 1];
    alignas(64) float b0[kBundles + 1], b1[kBundles + 1], q0[kBundles + 1], q1[kBundles + 1];
    alignas(64) float bundle_limit[kBundles + 1];

    // False if these rays do not make a pencil.
    HWY_ATTR bool gather(const Target& target, const RayStream& rays, uint32_t begin, uint32_t n);

    HWY_INLINE HWY_ATTR void update_limit(uint32_t bundle) {
        const float* limits = limit + bundle * kBundleRays;
        V8 largest = hn::Load(k8, limits);
        for (size_t i = kLanes8; i < kBundleRays; i += kLanes8)
            largest = hn::Max(largest, hn::Load(k8, limits + i));
        bundle_limit[bundle] = hn::GetLane(hn::MaxOfLanes(k8, largest));
    }

    // ... of all bundles.
    HWY_INLINE HWY_ATTR void update_limit_of_all() {
        V8 largest = hn::Load(k8, bundle_limit);
        for (size_t g = kLanes8; g < kBundles; g += kLanes8)
            largest = hn::Max(largest, hn::Load(k8, bundle_limit + g));
        bundle_limit[kBundles] = hn::GetLane(hn::MaxOfLanes(k8, largest));
    }

    HWY_INLINE HWY_ATTR uint32_t reaching(uint32_t mask, float z) const {
        uint32_t bits = 0;
        for (uint32_t g = 0; g < kBundles; g += kLanes8)
            bits |= bits_of(k8, hn::Ge(hn::Load(k8, bundle_limit + g), hn::Set(k8, z))) << g;
        return bits & mask;
    }

private:
    // `distance` is how far anything can be.
    template <bool Full>
    HWY_ATTR bool gather_rays(const RayStream& rays, float distance);
};

template <bool Full>
HWY_ATTR bool Pencil::gather_rays(const RayStream& rays, float distance) {
    // Mean width of a bundle, in slopes and in feet by length; measured: beyond, waves are faster.
    constexpr float kWidest = 0.05f;
    const uint32_t middle = first + count / 2;
    const V8 infinity = hn::Set(k8, std::numeric_limits<float>::infinity());
    const V8 sign_v = hn::Set(k8, sign), plane = hn::Set(k8, plane_z);
    V8 steepest = hn::Zero(k8), least_scale = hn::Set(k8, 0x1p32f), most_scale = hn::Zero(k8);
    V8 begin = infinity;
    const uint32_t bundle_count = (count + kBundleRays - 1) / kBundleRays;
    for (uint32_t g = 0; g < bundle_count; ++g) {
        Extent slopes, feet;
        uint32_t steep = 0;
        V8 farthest = hn::Set(k8, -1.0f);
        for (uint32_t i = g * kBundleRays; i < (g + 1) * kBundleRays; i += kLanes8) {
            const M8 there = hn::FirstN(k8, Full ? kLanes8 : i < count ? count - i : 0);
            const auto load = [&](const float* array) HWY_ATTR {
                if (Full) return hn::LoadU(k8, array + first + i);
                const V8 stand_in = hn::Set(k8, array[middle]);
                return i < count ? hn::IfThenElse(there, hn::LoadU(k8, array + first + i), stand_in)
                                 : stand_in;
            };
            const V8 scale = hn::Mul(load(rays.direction[kz]), sign_v);
            const V8 p = hn::Div(load(rays.direction[kx]), scale);
            const V8 q = hn::Div(load(rays.direction[ky]), scale);
            const V8 foot = hn::Mul(hn::Sub(load(rays.origin[kz]), plane), sign_v);
            hn::Store(hn::Mul(p, sign_v), k8, sx + i);
            hn::Store(hn::Mul(q, sign_v), k8, sy + i);
            slopes.add(p, q);
            feet.add(hn::NegMulAdd(p, foot, load(rays.origin[kx])),
                     hn::NegMulAdd(q, foot, load(rays.origin[ky])));
            const V8 slope = hn::Max(hn::Abs(p), hn::Abs(q));
            steepest = hn::Max(steepest, slope);
            steep |= bits_of(k8, hn::Ge(slope, hn::Set(k8, 1.0f))) << (i % kBundleRays);
            least_scale = hn::Min(least_scale, scale);
            most_scale = hn::Max(most_scale, scale);
            begin = hn::Min(begin, hn::MulAdd(load(rays.t_min), scale, foot));
            const V8 end = hn::MulAdd(load(rays.t_max), scale, foot);
            const V8 limits = hn::IfThenElse(there, end, hn::Set(k8, -1.0f));
            hn::Store(limits, k8, limit + i);
            farthest = hn::Max(farthest, limits);
        }
        foreign[g] = uint8_t(steep);
        alignas(16) float reduced[4];
        hn::Store(slopes.reduce(), k4, reduced);
        p0[g] = reduced[0];
        q0[g] = reduced[1];
        p1[g] = -reduced[2];
        q1[g] = -reduced[3];
        hn::Store(feet.reduce(), k4, reduced);
        a0[g] = reduced[0];
        b0[g] = reduced[1];
        a1[g] = -reduced[2];
        b1[g] = -reduced[3];
        bundle_limit[g] = hn::GetLane(hn::MaxOfLanes(k8, farthest));
    }
    for (uint32_t g = bundle_count; g < kBundles; ++g) {
        a0[g] = a1[g] = a0[0], p0[g] = p1[g] = p0[0];
        b0[g] = b1[g] = b0[0], q0[g] = q1[g] = q0[0];
        bundle_limit[g] = -1;
    }
    for (float* lowest : {a0, p0, b0, q0})
        lowest[kBundles] = *std::min_element(lowest, lowest + kBundles);
    for (float* highest : {a1, p1, b1, q1})
        highest[kBundles] = *std::max_element(highest, highest + kBundles);
    if (!(hn::GetLane(hn::MaxOfLanes(k8, steepest)) <= kMaxSlope
          && hn::GetLane(hn::MinOfLanes(k8, least_scale)) >= 0x1p-32f
          && hn::GetLane(hn::MaxOfLanes(k8, most_scale)) <= 0x1p32f))
        return false;
    float slope_width = 0, foot_width = 0, length = 0;
    for (uint32_t g = 0; g < bundle_count; ++g) {
        slope_width += (p1[g] - p0[g]) + (q1[g] - q0[g]);
        foot_width += (a1[g] - a0[g]) + (b1[g] - b0[g]);
        length += std::clamp(bundle_limit[g], 0.0f, distance);
    }
    if (!(slope_width <= kWidest * float(bundle_count) && foot_width <= kWidest * length))
        return false;
    near = hn::GetLane(hn::MinOfLanes(k8, begin));
    bundles = uint32_t((uint64_t(1) << bundle_count) - 1);
    return near >= 0;
}

inline HWY_ATTR math::Box bounds_of_origins(const RayStream& rays, uint32_t begin, uint32_t n) {
    math::Box box;
    for (int k = 0; k < 3; ++k) {
        const float* origin = rays.origin[k] + begin;
        V8 lower = hn::Set(k8, origin[0]), upper = lower;
        for (uint32_t i = 0; i < n; i += kLanes8) {
            const M8 there = hn::FirstN(k8, n - i);
            const V8 value = hn::IfThenElse(there, hn::LoadU(k8, origin + i), lower);
            lower = hn::Min(lower, value);
            upper = hn::Max(upper, value);
        }
        box.lower[k] = hn::GetLane(hn::MinOfLanes(k8, lower));
        box.upper[k] = hn::GetLane(hn::MaxOfLanes(k8, upper));
    }
    return box;
}

inline HWY_ATTR bool Pencil::gather(const Target& target, const RayStream& rays, uint32_t begin,
                                    uint32_t n) {
    first = begin;
    count = n;
    const math::Ray ray = ray_at(rays, begin + n / 2);
    const geometry::Axes axes = geometry::axes_of(ray.direction);
    kx = axes.kx, ky = axes.ky, kz = axes.kz;
    sign = ray.direction[kz] < 0 ? -1.0f : 1.0f;
    const math::Box origins = bounds_of_origins(rays, begin, n);
    plane_z = sign > 0 ? origins.lower[kz] : origins.upper[kz];
    const float distance = std::max(reach<float>(target.bounds, origins.lower),
                                    reach<float>(target.bounds, origins.upper));
    if (!fits_float(1, distance)) return false;
    const float far_away =
        std::max(largest_component(origins.lower), largest_component(origins.upper));
    // Rounding of a and b adds 3 e (distance + far_away) to what Beam and slabs.h allow for.
    margin = 0x1p-20f * distance + 0x1p-21f * far_away;
    return n % kBundleRays == 0 ? gather_rays<true>(rays, distance)
                                : gather_rays<false>(rays, distance);
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
