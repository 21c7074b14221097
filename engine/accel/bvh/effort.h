#pragma once

#include "accel/bvh/task.h"

namespace peregrine::accel::bvh {

// What an overlap of siblings must have, as a part of the root's box and of their parent's, to be
// worth a look for a spatial split. The first is a time for so much gain in cost: a node with n of
// N references takes n, and gains n times its area's part.
inline constexpr float kOverlapOfRoot = 50;
inline constexpr float kOverlapOfNode = 0.1f;

inline Effort effort_for(Quality quality) {
    switch (quality) {
    case Quality::fast:
        return {16, 0, true, 16, 4, 0, 0, 67};
    case Quality::best:
        return {32, 32, false, 16, 1, 6, 0.3, 67};
    default:
        return {16, 16, false, 16, 2, 1, 0.25, 67};
    }
}

} // namespace peregrine::accel::bvh
