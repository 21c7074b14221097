#pragma once

#include "shade/path/media.h"
#include "shade/surface/surface.h"

#include <algorithm>
#include <cstdint>

namespace peregrine::shade {

inline constexpr uint32_t kMostPathRays = 1024; // a tile's
inline constexpr uint32_t kPathRoom = kMostPathRays + 16;

// Rays that mirrors or glass sent on, at most one of a pixel, in the order of their pixels.
// Directions are as long as that of the pixel's first ray, so t goes on counting along the path.
struct alignas(64) PathRays {
    using Lanes = float[kPathRoom];

    Lanes origin[3]; // in a SurfaceSpace
    Lanes direction[3];
    Lanes weight[3]; // what counts of the radiance that it finds
    Lanes travelled; // t at which it begins
    uint32_t pixel[kPathRoom];
    Media media[kPathRoom];
    uint32_t count;
};

// What goes on from the hits of a batch, in parts of what each ray finds. A weight of 0: nothing.
struct alignas(64) SplitRays {
    using Lanes = Surface::Lanes;

    struct Branch {
        Lanes origin[3];
        Lanes direction[3];
        Lanes weight[3];
        Media media[kBatch];
    };
    Branch mirrored;
    Branch through;
    bool any; // else nothing of it is set

    void clear() {
        for (Branch* branch : {&mirrored, &through})
            std::fill_n(&branch->weight[0][0], 3 * kPadded, 0.0f);
        any = true;
    }

    // On the way there: of solids, the index that the ray comes from over that which it goes to; of
    // what is translucent, how much it covers.
    Lanes eta;
    Lanes cover;
};

// Where the rays go that programs of the host ask for.
struct AskedRays {
    SplitRays& split;   // of the batch, once mirrors and glass have taken from it
    const Media* media; // that the rays of the batch arrive in
};

// One thread's working memory for paths.
struct alignas(64) PathMemory {
    SplitRays split;
    Surface::Lanes radiance[3]; // of a batch
    Surface::Lanes weight[3];
    Surface::Lanes absorption[3];
    Surface::Lanes clear;    // of fog
    Media eye_media[kBatch]; // of rays from the eye

    // Of the rays that are being followed, and of what they hit.
    PathRays::Lanes world_origin[3];
    PathRays::Lanes t_min;
    PathRays::Lanes t_max;
    PathRays::Lanes t, u, v;
    PathRays::Lanes along; // t of the path
    uint32_t triangle[kPathRoom];
    uint32_t back_face[kPathRoom];

    PathRays* waiting; // two of each depth, see Paths; not part of this
    float footprint;   // see RayHits
    uint64_t ray_count;
};

} // namespace peregrine::shade
