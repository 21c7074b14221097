#pragma once

#include "geometry/triangle.h"

#include <cstdint>
#include <span>

namespace peregrine::bench {

struct PeerBuild {
    double seconds = 0; // wall
    uint64_t bytes = 0; // of the structure, without vertices and indices
};

// Whether this build has Embree.
bool has_embree();

// Embree's best quality (spatial splits) over one triangle mesh.
PeerBuild build_with_embree(std::span<const geometry::Triangle> triangles, uint32_t threads);

} // namespace peregrine::bench
