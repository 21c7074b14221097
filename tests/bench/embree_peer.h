#pragma once

#include "geometry/triangle.h"

#include <cstdint>
#include <span>
#include <string>

namespace peregrine::bench {

struct PeerBuild {
    double seconds = 0; // wall
    uint64_t bytes = 0; // of the structure, without vertices and indices
};

// Whether this build has Embree.
bool has_embree();

// Over one triangle mesh; `quality` is low, medium or high (spatial splits).
PeerBuild build_with_embree(std::span<const geometry::Triangle> triangles, uint32_t threads,
                            const std::string& quality);

} // namespace peregrine::bench
