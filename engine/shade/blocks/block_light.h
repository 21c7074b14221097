#pragma once

#include "shade/blocks/tile_light.h"
#include "shade/shader.h"

namespace peregrine::shade {

// Light at the rate at which it changes: after the discontinuity buffer of Arauna (Bikker 2007,
// section 5.1), on the light itself. In a block that is smooth to look at, light is found at the
// corners and in the middle. If they see the same lights, all of the block is taken to; if the
// middle is what lies between the corners, then so is the rest; else the block is cut into four. In
// the least blocks that are not smooth, groups of near pixels share what they see, not their light.
class BlockLight {
public:
    // `tolerance`: see rt_frame_desc. `pixel`: the side of a pixel at a distance of 1. `least`:
    // radiance that does not show.
    BlockLight(const Shader& shader, const scene::Environment& environment, float tolerance,
               float pixel, float least);

    // `out.pending` has the tile's blocks; rays of none are wanted.
    void find(const TileHits& hits, TileLight& out, Scratch& scratch) const;

private:
    void try_blocks(const TileHits& hits, uint32_t level, TileLight& out, Scratch& scratch) const;
    void judge(Block block, TileLight& out) const;
    bool is_even(const Block& block, const TileLight& light) const;
    bool is_between(const Block& block, const TileLight& light) const;
    bool join_marks(const Block& block, const TileLight& light, LightMarks& all) const;
    void interpolate(const Block& block, TileLight& out) const;
    void try_groups(const TileHits& hits, TileLight& out, Scratch& scratch) const;
    void want_groups(const Block& block, const PixelGroups& groups, TileLight& out) const;
    void want_all(const Block& block, TileLight& out) const;
    void find_wanted(const TileHits& hits, SurfacePart part, TileLight& out,
                     Scratch& scratch) const;
    void tell_known(uint32_t count, TileLight& out) const;
    void note_samples(uint32_t count, TileLight& out, const Surface& surface) const;
    void find_batch(const TileHits& hits, SurfacePart part, uint32_t count, TileLight& out,
                    Scratch& scratch) const;

    const Shader& shader_;
    math::Vec3 ambient_; // as irradiance
    float tolerance_;
    float pixel_;
    float least_; // irradiance
};

} // namespace peregrine::shade
