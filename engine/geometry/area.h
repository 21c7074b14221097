#pragma once

#include "math/vec.h"

#include <cmath>

namespace peregrine::geometry {

// Beyond this a coordinate's square would overflow double precision products further on.
inline constexpr float kLargestCoordinate = 1e30f;

inline bool is_usable(const math::Vec3& p) {
    return bool(int(std::fabs(p.x) <= kLargestCoordinate)
                & int(std::fabs(p.y) <= kLargestCoordinate)
                & int(std::fabs(p.z) <= kLargestCoordinate)); // one branch
}

// Whether the cross product of two edges is not zero, in double: differences of floats are exact
// there but for extreme ratios. A triangle without area is part of no surface and of no tree.
inline bool has_area(const math::Vec3& v0, const math::Vec3& v1, const math::Vec3& v2) {
    const math::Vec3d a = math::Vec3d(v1) - math::Vec3d(v0);
    const math::Vec3d b = math::Vec3d(v2) - math::Vec3d(v0);
    return a.y * b.z != a.z * b.y || a.z * b.x != a.x * b.z || a.x * b.y != a.y * b.x;
}

} // namespace peregrine::geometry
