#pragma once

#include "math/box.h"
#include "math/vec.h"

#include <algorithm>
#include <cmath>

namespace peregrine::math {

// p -> x column[0] + y column[1] + z column[2] + offset, in double and in this order of operations.
struct Affine {
    Vec3d column[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Vec3d offset{0};

    Vec3d vector(const Vec3d& v) const {
        return (column[0] * v.x + column[1] * v.y) + column[2] * v.z;
    }
    Vec3d point(const Vec3d& p) const { return vector(p) + offset; }

    // The transpose of the linear part: what the inverse does to normals.
    Vec3d transposed(const Vec3d& v) const {
        return {glm::dot(column[0], v), glm::dot(column[1], v), glm::dot(column[2], v)};
    }

    // In the maximum norm: the largest sum of magnitudes of a row.
    double norm() const {
        const Vec3d rows = (glm::abs(column[0]) + glm::abs(column[1])) + glm::abs(column[2]);
        return std::max({rows.x, rows.y, rows.z});
    }
};

inline double determinant(const Affine& m) {
    return glm::dot(m.column[0], glm::cross(m.column[1], m.column[2]));
}

// Not finite if there is none.
inline Affine inverse(const Affine& m) {
    const Vec3d r0 = glm::cross(m.column[1], m.column[2]);
    const Vec3d r1 = glm::cross(m.column[2], m.column[0]);
    const Vec3d r2 = glm::cross(m.column[0], m.column[1]);
    const double d = 1 / glm::dot(m.column[0], r0);
    Affine out;
    for (int k = 0; k < 3; ++k) out.column[k] = Vec3d(r0[k], r1[k], r2[k]) * d;
    out.offset = -out.vector(m.offset);
    return out;
}

// Around the image of the box, in double.
inline void find_bounds(const Affine& m, const Box& box, Vec3d& lower, Vec3d& upper) {
    const Vec3d center = (Vec3d(box.lower) + Vec3d(box.upper)) * 0.5;
    const Vec3d half = (Vec3d(box.upper) - Vec3d(box.lower)) * 0.5;
    const Vec3d middle = m.point(center);
    const Vec3d reach = ((glm::abs(m.column[0]) * half.x + glm::abs(m.column[1]) * half.y)
                         + glm::abs(m.column[2]) * half.z)
                        + glm::abs(middle) * 0x1p-48;
    lower = middle - reach * (1 + 0x1p-48);
    upper = middle + reach * (1 + 0x1p-48);
}

// ... rounded outward to float.
inline Box bounds(const Affine& m, const Box& box) {
    Vec3d lower, upper;
    find_bounds(m, box, lower, upper);
    Box out;
    for (int k = 0; k < 3; ++k) {
        out.lower[k] = std::nextafter(float(lower[k]), -HUGE_VALF);
        out.upper[k] = std::nextafter(float(upper[k]), HUGE_VALF);
    }
    return out;
}

} // namespace peregrine::math
