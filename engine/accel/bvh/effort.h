#pragma once

#include "accel/bvh/task.h"

namespace peregrine::accel::bvh {

// A spatial split is tried where the overlap of siblings is larger than both of these: a part of
// the root's area, the first over the square root of the number of triangles; and a part of their
// parent's area, the second. Found by trial: less costs time and duplicates for no gain.
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
