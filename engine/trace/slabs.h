#pragma once

#include "math/box.h"
#include "math/ray.h"

#include <algorithm>
#include <cmath>

// What makes traversal conservative: it may visit too much, never too little.
//
// By the theorem of geometry/intersect.h a hit at t lies within 8.1 e D of a point P of its
// triangle, e = 2^-24, D the largest |corner - origin|_inf of the scene's bounds. P lies in a leaf
// that references the triangle. Let k be the axis of a split s on the way there, P_k <= s. The hit
// is on the side origin_k + t d_k <= s + 8.1 e D, so with a positive d_k its t is at most
//     (s - origin_k) / d_k  +  8.1 e D / |d_k|.
// Computing (s - origin_k) * (1 / d_k) in float errs by 3.01 e D / |d_k|, adding or subtracting the
// margin by 1.1 e D / |d_k|, raising a |d_k| below 2^-26 |d|_inf to that by 0.25 e D / |d_k|
// (which also keeps a parallel ray finite: within the margin of the plane it visits both sides).
// The sum is 12.5 e D / |d_k|. We take 16: margin_k = 2^-20 D / |d_k|. Every interval of t that a
// traversal computes for a cell, widened by the margins, contains the t of every hit on a triangle
// whose witness P lies in the cell. The slabs of a box are splits too (cf. Ize 2013, who
// widens by 2 ulps of t because his intersection is taken to be exact).
//
// Rays whose numbers could leave the normal range of float take the same code in double.
namespace peregrine::trace {

template <class Real>
struct Slabs {
    Real origin[3];
    Real inverse[3]; // 1 / direction, finite
    Real margin[3];
    Real t_near, t_far; // where the ray may be inside the bounds
};

// The largest distance along an axis from the origin to a corner.
template <class Real>
Real reach(const math::Box& bounds, const math::Vec3& origin) {
    Real reach = 0;
    for (int k = 0; k < 3; ++k) {
        const Real lower = std::abs(Real(bounds.lower[k]) - Real(origin[k]));
        const Real upper = std::abs(Real(bounds.upper[k]) - Real(origin[k]));
        reach = std::max(reach, std::max(lower, upper));
    }
    return reach;
}

inline float largest_component(const math::Vec3& v) {
    return std::max(std::max(std::fabs(v.x), std::fabs(v.y)), std::fabs(v.z));
}

// Whether all of Slabs<float> stays in the normal range, far from its ends.
inline bool fits_float(float direction, float reach) {
    return direction >= 0x1p-32f && direction <= 0x1p32f && reach >= 0x1p-40f && reach <= 0x1p60f;
}

template <class Real>
Slabs<Real> slabs(const math::Box& bounds, const math::Ray& ray, Real reach) {
    Slabs<Real> s;
    // 2^-146 in space, and 2^-149 in t below: rounding in the denormal range is absolute.
    const Real error = Real(0x1p-20f) * reach + Real(0x1p-146f);
    const Real smallest = Real(0x1p-26f) * Real(largest_component(ray.direction));
    s.t_near = Real(ray.t_min);
    s.t_far = Real(ray.t_max);
    for (int k = 0; k < 3; ++k) {
        const Real d = Real(ray.direction[k]);
        s.origin[k] = Real(ray.origin[k]);
        s.inverse[k] = Real(1) / (std::abs(d) < smallest ? std::copysign(smallest, d) : d);
        s.margin[k] = error * std::abs(s.inverse[k]) + Real(0x1p-149f);
        const Real lower = (Real(bounds.lower[k]) - s.origin[k]) * s.inverse[k];
        const Real upper = (Real(bounds.upper[k]) - s.origin[k]) * s.inverse[k];
        s.t_near = std::max(s.t_near, std::min(lower, upper) - s.margin[k]);
        s.t_far = std::min(s.t_far, std::max(lower, upper) + s.margin[k]);
    }
    return s;
}

} // namespace peregrine::trace
