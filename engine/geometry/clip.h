#pragma once

#include "geometry/triangle.h"

#include <cstdint>

namespace peregrine::geometry {

// Boxes that hold every point that the triangle and a closed cell have in common: conservative to
// the last bit, and within about one rounding to float of the tightest. Empty if nothing is common.

Box clip(const Triangle& triangle, const Box& cell);

struct ClippedHalves {
    Box below;
    Box above;
};

// For both parts of a cell that is cut at `position`. `known` bounds the triangle in the cell.
ClippedHalves clip_to_halves(const Triangle& triangle, const Box& cell, uint32_t axis,
                             float position, const Box& known);

} // namespace peregrine::geometry
