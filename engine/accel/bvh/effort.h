#pragma once

#include "accel/bvh/task.h"

namespace peregrine::accel::bvh {

// What an overlap of siblings must have to be worth a look for a spatial split: of the root's area,
// this by the square root of the number of triangles, and of their parent's. Found by trial: less
// costs time and duplicates for no gain.
inline constexpr float kOverlapOfRoot = 1;
inline constexpr float kOverlapOfNode = 0.1f;

inline Effort effort_for(Quality quality) {
    Effort effort{.bins = 16,
                  .spatial_bins = 16,
                  .subtree = 1024,
                  .treelet = 16,
                  .binary_leaf = 2,
                  .reinsertions = 2,
                  .reinserted = 0.25,
                  .duplicates = 0.25,
                  .bytes = 67};
    if (quality == Quality::fast) {
        effort.subtree = 16;
        effort.binary_leaf = 1;
        effort.spatial_bins = effort.reinsertions = 0;
        effort.duplicates = 0;
    } else if (quality == Quality::best) {
        effort.bins = effort.spatial_bins = 32;
        effort.binary_leaf = 1;
        effort.reinsertions = 6;
        effort.reinserted = 1;
        effort.duplicates = 0.3;
    }
    return effort;
}

} // namespace peregrine::accel::bvh
