#pragma once

#include "math/vec.h"

#include <algorithm>
#include <limits>

namespace peregrine::math {

// Axis-aligned and closed. The default box is empty: lower > upper.
struct Box {
    Vec3 lower{std::numeric_limits<float>::infinity()};
    Vec3 upper{-std::numeric_limits<float>::infinity()};

    bool empty() const { return lower.x > upper.x || lower.y > upper.y || lower.z > upper.z; }

    void extend(const Vec3& point) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }

    void extend(const Box& box) {
        lower = glm::min(lower, box.lower);
        upper = glm::max(upper, box.upper);
    }
};

inline Box intersection(const Box& a, const Box& b) {
    return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
}

// In double: the sides of a box may be 1e30.
inline double half_area(const Box& box) {
    const double x = double(box.upper.x) - double(box.lower.x);
    const double y = double(box.upper.y) - double(box.lower.y);
    const double z = double(box.upper.z) - double(box.lower.z);
    return x * y + y * z + z * x;
}

} // namespace peregrine::math
