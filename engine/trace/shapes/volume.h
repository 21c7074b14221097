#pragma once

#include "trace/shapes/shapes.h"
#include "trace/slabs.h"

// Shapes go through the same nodes as rays: the path of the centre against boxes that are wider by
// what the shape fills around it (Minkowski sum), which for slabs means a wider margin.
//
// Let D be the largest distance along an axis from the origin to a corner of the bounds, E the
// largest extent, e = 2^-24. A contact at t has a witness P on its triangle, hence in a leaf's box,
// that the shape at t is within 2^-20 M of touching (geometry/shapes/features.h), where M is a
// 1-norm of numbers below D + E: 3 * 2^-20 (D + E). To this slabs.h adds 5.5 e (D + E) for
// arithmetic, parallel paths and the rounding of t. The sum is below 2^-18 (D + E); 2^-17 are
// taken.
namespace peregrine::trace {

inline double reach_of(const math::Box& bounds, const Volume& volume) {
    double reach = 0;
    for (int k = 0; k < 3; ++k) {
        const double lower = std::fabs(double(bounds.lower[k]) - volume.origin[k]);
        const double upper = std::fabs(double(bounds.upper[k]) - volume.origin[k]);
        reach = std::max(reach, std::max(lower, upper) + volume.extent[k]);
    }
    return reach;
}

inline double largest_component(const math::Vec3d& v) {
    return std::max(std::max(std::fabs(v.x), std::fabs(v.y)), std::fabs(v.z));
}

inline bool fits_float(const Volume& volume, double reach) {
    const double speed = largest_component(volume.direction);
    return (speed == 0 || (speed >= 0x1p-32 && speed <= 0x1p32)) && reach >= 0x1p-40
           && reach <= 0x1p60 && largest_component(volume.origin) <= 0x1p60;
}

// A ball around the same origin, of another radius in the world.
inline Volume with_radius(const Volume& ball, double radius) {
    Volume other = ball;
    other.radius = radius * ball.stretch + ball.slack;
    other.extent = math::Vec3d(other.radius);
    return other;
}

// Of a ball in the world that reaches a bit of the bounds.
inline double first_radius(const math::Box& bounds, const Volume& volume) {
    double gap = 0, side = 0;
    for (int k = 0; k < 3; ++k) {
        const double lower = double(bounds.lower[k]), upper = double(bounds.upper[k]);
        gap = std::max(gap, std::max(lower - volume.origin[k], volume.origin[k] - upper));
        side = std::max(side, upper - lower);
    }
    return (gap + side / 64) / volume.stretch;
}

// For a volume at rest every axis is measured in lengths, at the one time 0.
template <class Real>
Slabs<Real> slabs(const Volume& volume, double reach, float t_max) {
    Slabs<Real> s;
    const double smallest = 0x1p-26 * largest_component(volume.direction);
    const double error = 0x1p-17 * reach + 0x1p-146;
    for (int k = 0; k < 3; ++k) {
        const double d = volume.direction[k];
        s.origin[k] = Real(volume.origin[k]);
        s.inverse[k] = smallest == 0
                           ? Real(1)
                           : Real(1 / (std::fabs(d) < smallest ? std::copysign(smallest, d) : d));
        s.margin[k] =
            Real((volume.extent[k] + error) * std::fabs(double(s.inverse[k]))) + Real(0x1p-149f);
    }
    s.t_near = 0;
    s.t_far = smallest == 0 ? Real(0) : Real(t_max);
    return s;
}

} // namespace peregrine::trace
