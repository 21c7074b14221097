#pragma once

#include "shade/occlusion/tile_openness.h"
#include "shade/shader.h"

namespace peregrine::shade {

// How far blocks may be from what is interpolated: see rt_frame_desc.
struct OpennessTolerance {
    float openness = 0;
    float normal = 0;
    float plane = 0;
};

// Openness where it changes: a hierarchical discontinuity buffer (Bikker 2007, section 5.1). Its
// three conditions, for the corners of a block and its middle: they lie on a plane, as all of the
// block does; their normals are alike; and so is their openness. Then what is between the corners
// is interpolated; else the block is cut into four, and in the end into pixels, of which neighbours
// on one triangle may share.
class BlockOpenness {
public:
    // `pixel`: the side of a pixel at a distance of 1.
    BlockOpenness(const Shader& shader, const OpennessTolerance& tolerance, float pixel);

    // `out.blocks` has the tile's blocks; rays of none are wanted.
    void find(const TileHits& hits, TileOpenness& out, Scratch& scratch) const;

private:
    void recall(const TileHits& hits, TileOpenness& out, Scratch& scratch) const;
    static bool keeps(const Block& block, TileOpenness& out);
    void try_blocks(const TileHits& hits, uint32_t level, TileOpenness& out,
                    Scratch& scratch) const;
    void try_quads(const TileHits& hits, TileOpenness& out, Scratch& scratch) const;
    bool is_even(const Block& block, const TileOpenness& found) const;
    void find_wanted(const TileHits& hits, TileOpenness& out, Scratch& scratch) const;

    const Shader& shader_;
    OpennessTolerance tolerance_;
    float least_cosine_;
    float pixel_;
};

} // namespace peregrine::shade
