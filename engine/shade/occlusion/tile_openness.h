#pragma once

#include "shade/blocks/block_lists.h"
#include "shade/blocks/tile_hits.h"
#include "shade/occlusion/openness.h"

namespace peregrine::shade {

// One thread's working memory for the openness of a tile, and the result, ray by ray.
struct alignas(64) TileOpenness {
    static constexpr uint32_t kPaddedRays = kMostTileRays + 16;
    using Lanes = float[kPaddedRays];
    static constexpr uint8_t kWanted = 1;

    Lanes openness;
    Lanes normal[3];              // where openness was found, without normal maps
    bool found[kMostTileRays];    // by rays, or ...
    bool recalled[kMostTileRays]; // if the shader recalls it
    uint8_t wanted[kMostTileRays];
    BlockLists blocks; // uneven: not to be interpolated
    PickedHits picked;
    Surface::Lanes batch; // openness
    OpennessMemory memory;
    uint64_t point_count; // of a frame

    void begin(uint32_t ray_count) { // a tile
        std::fill_n(found, ray_count, false);
        std::fill_n(wanted, ray_count, uint8_t(0));
        blocks.clear();
    }
    void want(uint32_t ray) { wanted[ray] = found[ray] ? 0 : kWanted; }
};

} // namespace peregrine::shade
