#pragma once

#include "shade/light/shadows.h"
#include "shade/occlusion/open_points.h"

namespace peregrine::shade {

struct RayHits;

// One thread's working memory.
struct alignas(64) OpennessMemory {
    OpenPoints points; // that are asked
    Surface::Lanes length;
    uint32_t free[kPadded]; // rays of each
    float free_part[kPadded];
    uint64_t ray_count; // of a frame
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

    // Where it is negative, at the points of a surface (SurfacePart::smooth); 1 where nothing was
    // hit. The same ray of all points goes as one stream: neighbours ask in about the same
    // direction. That is faster than all rays of one point after the other, and waves are faster
    // than pencils: rays are short.
    void find(const RayHits& hits, const Surface& surface, ShadowMemory& shadow,
              OpennessMemory& memory, float* openness) const;

    // Takes from it what moving meshes hide, where it is not negative.
    void hide_by_moving(const RayHits& hits, const Surface& surface, ShadowMemory& shadow,
                        OpennessMemory& memory, float* openness) const;

private:
    enum class World { whole, moving };

    // Of the rays of memory.points.
    void find_free_parts(World world, ShadowMemory& shadow, OpennessMemory& memory) const;
    void trace(const OpenRay& ray, World world, ShadowMemory& shadow, OpennessMemory& memory) const;

    Shadows shadows_;
    float range_;
    OpenRays rays_;
};

} // namespace peregrine::shade
