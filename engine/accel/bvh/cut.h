#pragma once

#include "accel/reference.h"
#include "geometry/triangle.h"

namespace peregrine::accel::bvh {

struct Halves {
    Bounds below;
    Bounds above;
};

// Boxes of what a plane leaves on either side of a reference: they hold every point of the triangle
// in the reference's box, to the last bit. One is empty if nothing is there.
Halves cut(const geometry::Triangle& triangle, const Reference& reference, uint32_t axis,
           float position);

} // namespace peregrine::accel::bvh
