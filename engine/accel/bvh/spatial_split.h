#pragma once

#include "accel/reference.h"
#include "geometry/triangle.h"

#include <limits>
#include <span>

namespace peregrine::accel::bvh {

inline constexpr uint32_t kMaxSpatialBins = 64;

// A plane that cuts triangles (Stich, Friedrich and Dietrich 2009, section 4).
struct SpatialSplit {
    float cost = std::numeric_limits<float>::infinity(); // as Split
    uint32_t axis = 0;
    float position = 0;
    uint32_t left = 0; // references on either side, about
    uint32_t right = 0;
};

SpatialSplit find_spatial_split(const geometry::Triangle* triangles,
                                std::span<const Reference> references, const Bounds& bounds,
                                uint32_t bins, uint32_t most_duplicates);

} // namespace peregrine::accel::bvh
