#pragma once

#include "shade/light/shadows.h"
#include "shade/occlusion/open_rays.h"

namespace peregrine::shade {

struct RayHits;

// One thread's working memory.
struct alignas(64) OpennessMemory {
    Surface::Lanes axis[3][3];   // of each point that is asked: across, along, the normal, ...
    Surface::Lanes geometric[3]; // ... and that of its triangle
    Surface::Lanes length;
    uint32_t point[kPadded]; // of the batch
    uint32_t open[kPadded];  // rays
    uint64_t ray_count;      // of a frame
};

// How open places are: the part of the ambient light that arrives, 0 to 1. Ambient occlusion: rays
// go out about the interpolated normal, not what a normal map makes of it, so that openness changes
// slowly over a surface. Read-only: all threads share it.
class Openness {
public:
    // `range`: metres, > 0; +infinity: all rays have no end. Surfaces are relative to
    // `space.origin`.
    Openness(const scene::Snapshot& snapshot, const SurfaceSpace& space, float range,
             uint32_t samples);

    // At the points of a surface (SurfacePart::smooth); 1 where nothing was hit. The same ray of
    // all points goes as one stream: neighbours ask in about the same direction. That is faster
    // than all rays of one point after the other, and waves are faster than pencils: rays are
    // short.
    void find(const RayHits& hits, const Surface& surface, ShadowMemory& shadow,
              OpennessMemory& memory, float* openness) const;

private:
    uint32_t list_points(const RayHits& hits, const Surface& surface, ShadowMemory& shadow,
                         OpennessMemory& memory) const;
    void aim(const OpenRay& ray, uint32_t count, ShadowMemory& shadow,
             const OpennessMemory& memory) const;
    void trace(const OpenRay& ray, uint32_t count, ShadowMemory& shadow,
               OpennessMemory& memory) const;

    Shadows shadows_;
    float range_;
    OpenRays rays_;
};

} // namespace peregrine::shade
