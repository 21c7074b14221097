#pragma once

#include "math/vec.h"

namespace peregrine::math {

// The points origin + t direction with t_min <= t <= t_max, both ends included.
struct Ray {
    Vec3 origin;
    float t_min;
    Vec3 direction;
    float t_max;
};
static_assert(sizeof(Ray) == 32, "rays travel in arrays, two to a cache line");

} // namespace peregrine::math
