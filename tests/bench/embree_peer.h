#pragma once

#include "geometry/triangle.h"

#include <cstdint>
#include <memory>
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

// A mesh whose vertices move, in a scene made for that: built anew of low quality, or refitted.
class PeerDeforming {
public:
    virtual ~PeerDeforming() = default;
    virtual double deform(std::span<const math::Vec3> positions) = 0; // processor seconds
};

std::unique_ptr<PeerDeforming> deform_with_embree(std::span<const uint32_t> indices,
                                                  std::span<const math::Vec3> positions,
                                                  uint32_t threads, bool refit);

} // namespace peregrine::bench
