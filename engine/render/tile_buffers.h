#pragma once

#include "base/slot_map.h"
#include "render/tile.h"
#include "shade/blocks/tile_light.h"
#include "shade/occlusion/tile_openness.h"
#include "shade/path/path_rays.h"
#include "shade/scratch.h"
#include "shade/surface/ray_hits.h"

namespace peregrine::render {
namespace post {
class LuminanceCounts;
}

static_assert(kTilePadded * sizeof(float) % 64 == 0, "the kernels want aligned arrays");

// One thread's working memory, used for tile after tile: what the stages of a plan hand on.
struct alignas(64) TileBuffers {
    Tile tile;

    alignas(64) float origin[3][kTilePadded]; // of the primary rays, ...
    alignas(64) float direction[3][kTilePadded];
    alignas(64) float t_min[kTilePadded];
    alignas(64) float t_max[kTilePadded];
    alignas(64) float t[kTilePadded]; // ... and of what they hit
    alignas(64) float u[kTilePadded];
    alignas(64) float v[kTilePadded];
    alignas(64) uint32_t triangle[kTilePadded];
    alignas(64) uint32_t back_face[kTilePadded];
    alignas(64) uint32_t steps[kTilePadded];
    alignas(64) uint32_t triangle_id[kTileRays]; // as the host knows them
    alignas(64) base::Handle mesh_id[kTileRays];

    float footprint; // see RayHits

    TileColors colors; // radiance, then display values
    shade::Scratch scratch;
    shade::TileLight* light = nullptr;          // if Frame::keeps_light()
    shade::TileOpenness* openness = nullptr;    // if the shader finds it
    uint64_t light_point_count = 0;             // of a frame
    uint64_t edge_ray_count = 0;                // of a frame
    uint64_t particle_ray_count = 0;            // of a frame
    shade::PathMemory* paths = nullptr;         // of plans that have any
    post::LuminanceCounts* luminance = nullptr; // of frames that measure it

    // Calls function(hits, first) for batches of rays, `first` being a batch's first.
    template <class Function>
    void for_each_batch(uint32_t ray_count, Function&& function) {
        for (uint32_t first = 0; first < ray_count; first += shade::kBatch)
            function(tile_hits().batch(first, std::min(ray_count - first, shade::kBatch)), first);
    }
    // ... of the tile.
    template <class Function>
    void for_each_batch(Function&& function) {
        for_each_batch(tile.count, function);
    }

    // Of the tile's rays; null if it is not wanted.
    const float* openness_from(uint32_t first) const {
        return openness ? openness->openness + first : nullptr;
    }

    shade::TileHits tile_hits() const {
        return {{direction[0], direction[1], direction[2]},
                t,
                u,
                v,
                triangle,
                back_face,
                tile.count,
                footprint};
    }

    struct Channels {
        float* channel[3];
    };
    Channels colors_from(uint32_t first) {
        return {{colors.channel[0] + first, colors.channel[1] + first, colors.channel[2] + first}};
    }

    static_assert(kTileRays % shade::kBatch == 0);
};

} // namespace peregrine::render
