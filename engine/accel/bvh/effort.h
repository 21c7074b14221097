#pragma once

#include "accel/bvh/task.h"

namespace peregrine::accel::bvh {

// What an overlap of siblings must have to be worth a look for a spatial split: of the root's area,
// this by the square root of the number of triangles, and of their parent's. A look at n of N
// references takes n, and gains at most n times the overlap's part of the root's area; the root is
// there because a tree's cost grows slower than N.
inline constexpr float kOverlapOfRoot = 0.5f;
inline constexpr float kOverlapOfNode = 0.1f;

inline Effort effort_for(Quality quality) {
    switch (quality) {
    case Quality::fast:
        return {16, 0, true, 16, 4, 0, 0, 0, 67};
    case Quality::best:
        return {32, 32, false, 16, 1, 6, 1, 0.3, 67};
    default:
        return {16, 16, false, 16, 2, 2, 0.25, 0.25, 67};
    }
}

} // namespace peregrine::accel::bvh
