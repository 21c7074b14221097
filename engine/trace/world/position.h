#pragma once

#include "math/vec.h"

#include <cstdint>

namespace peregrine::trace {

// Where a ray or a shape of a query is: a record in float, relative to a base in double, which is
// relative to the world's origin. Fixed and deforming meshes see their sum, rounded to float. A
// mesh with a space of its own sees it from where it stands, so that what is rounded is as small as
// the distance between them, and the same place is the same however it is told.
struct Position {
    math::Vec3 record;
    math::Vec3d base{0};

    math::Vec3d from(const math::Vec3d& point) const {
        return math::Vec3d(record) + (base - point);
    }
    // What is left of a coordinate of the sum once it is rounded.
    float rest(float rounded, int axis) const {
        return float((double(record[axis]) + base[axis]) - double(rounded));
    }
};

// Of a stream's rays.
struct Positions {
    const float* record[3];
    math::Vec3d base{0};

    Position operator[](uint32_t i) const {
        return {{record[0][i], record[1][i], record[2][i]}, base};
    }
};

} // namespace peregrine::trace
