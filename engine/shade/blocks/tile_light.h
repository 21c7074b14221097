#pragma once

#include "shade/blocks/block_lists.h"
#include "shade/blocks/pixel_groups.h"
#include "shade/blocks/tile_hits.h"
#include "shade/light/marks.h"
#include "shade/material/program.h"
#include "shade/surface/surface.h"

#include <cstdint>

namespace peregrine::shade {

// One thread's working memory for the light of a tile, and the result, ray by ray.
struct alignas(64) TileLight {
    static constexpr uint32_t kPaddedRays = kMostTileRays + 16;
    using Lanes = float[kPaddedRays];
    enum Want : uint8_t {
        kAsSample = 1, // now, without normal maps
        kAsPixel = 2,  // in the end
    };

    Lanes irradiance[3];
    Lanes highlight[3]; // with Program::highlight

    // Where light was found: what it was found for.
    Lanes normal[3];
    Lanes shininess;
    bool relief[kMostTileRays]; // and it was found without the normal map that is there
    LightMarks marks[kMostTileRays];
    uint8_t traced[kMostTileRays]; // with so many shadow rays, up to 255
    bool found[kMostTileRays];

    // Where it is to be found next, and what is known there: index in `known`.
    uint8_t wanted[kMostTileRays]; // bits of Want
    uint16_t known_of[kMostTileRays];

    BlockLists blocks; // uneven: pixels at several depths, or whose normals differ

    // A tile has 4 + 16 + 64 blocks, and those of the least side have groups.
    static constexpr uint32_t kMostKnown = 84 + 64 * PixelGroups::kMost;
    LightMarks known[kMostKnown];
    uint32_t known_count;

    // A batch of points.
    PickedHits picked;
    BatchMarks batch;
    LightSlots slots; // of the tile

    uint32_t point_count; // where light was found

    void begin(uint32_t ray_count); // a tile
    uint16_t know(const LightMarks& found_marks) {
        known[known_count] = found_marks;
        return uint16_t(known_count++);
    }
    void want(uint32_t ray, uint16_t known_index) {
        if (found[ray]) return;
        wanted[ray] |= kAsSample;
        known_of[ray] = known_index;
    }
    void want_whole(uint32_t ray, uint16_t known_index) {
        if (found[ray] && !relief[ray]) return;
        wanted[ray] |= kAsPixel;
        known_of[ray] = known_index;
    }
};

} // namespace peregrine::shade
