#pragma once

#include "math/box.h"
#include "math/vec.h"

#include <algorithm>

// How far points that are computed from barycentrics are moved off their triangle's plane, so that
// rays from them to the geometric normal's side cannot hit that plane again.
namespace peregrine::geometry {

// Of (1 - u - v) v0 + u v1 + v v2 in float, on each axis relative to the largest |v_i|: Pharr,
// Jakob, Humphreys, PBR 3rd edition, 3.9: gamma(7); two more roundings come from adding the lift
// itself.
inline constexpr float kPositionError = 9.0f * 0x1p-24f * 1.001f;

// How far the intersector may be off for rays that start at most `reach` from the vertices of the
// triangle and of its neighbours in the same plane, measured across it. geometry/intersect.h: a hit
// is closer than 8.1 e D to its triangle in the maximum norm, which is 14.1 e D across it. A ray
// that all but grazes the plane sinks by less than 4 e D below its rounded normal's horizon before
// it leaves the mesh. 20 covers both.
inline float intersection_error(float reach) {
    return 20.0f * 0x1p-24f * reach;
}

inline float largest_side(const math::Box& box) {
    if (box.empty()) return 0;
    const math::Vec3 size = box.upper - box.lower;
    return std::max({size.x, size.y, size.z});
}

// The largest |coordinates| of a triangle, axis by axis.
inline math::Vec3 largest_coordinates(const math::Vec3* v) {
    return glm::max(glm::max(glm::abs(v[0]), glm::abs(v[1])), glm::abs(v[2]));
}

// `largest`: of the triangle's |coordinates|; `normal`: unit, to the side of the rays.
inline math::Vec3 surface_lift(const math::Vec3& largest, const math::Vec3& normal,
                               float intersection_error) {
    return normal * (kPositionError * glm::dot(glm::abs(normal), largest) + intersection_error);
}

} // namespace peregrine::geometry
