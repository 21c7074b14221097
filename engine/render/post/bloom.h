#pragma once

#include "accel/buffer.h"
#include "render/film.h"
#include "render/post/kernels.h"
#include "render/tile.h"

#include <cstdint>

namespace peregrine::render::post {

// Light that is brighter than a display can show spreads to its surroundings, as it does in a lens
// and in the eye: after Jimenez, "Next Generation Post Processing in Call of Duty: Advanced
// Warfare", SIGGRAPH 2014. A pyramid of pictures of half the size each, made by a filter of six by
// six, is enlarged step by step by a tent. Each filter is one for the rows and then one for the
// columns. What a pixel gives is taken from it, so that the picture keeps its light; and as no
// pixel gives more than a limit, a single bright one does not flash.
class Bloom {
public:
    Bloom(const Frame& frame, base::Memory* memory);

    uint32_t level_count() const { return count_; }
    uint32_t height(uint32_t level) const { return levels_[level].height; }

    // Makes a row of a level from the one before it, or of the first one from the film.
    void halve(const Kernels& kernels, const Film& film, uint32_t level, uint32_t y);
    // Mixes with a row of a level what the next one has.
    void gather(const Kernels& kernels, uint32_t level, uint32_t y);

    // When all is made: spreads the light of the tile's rows, of kTileSize pixels each.
    void spread(const Kernels& kernels, const Tile& tile, float* const light[3]) const;
    // For the same with rays through other places of a pixel: what it gets, ...
    math::Vec3 glow_at(uint32_t x, uint32_t y) const;
    // ... and what they give.
    const OverBright& over_bright() const { return bright_; }

private:
    static constexpr uint32_t kMostLevels = 14;
    static constexpr uint32_t kPadding = 16; // beyond the last row

    struct Level {
        uint32_t width, height;
        size_t stride;
        size_t begin; // of its first plane
        float weight; // of it, beside all that are smaller
    };

    void choose_levels(const Extent& extent, float radius);
    const float* row(const Level& level, int channel, uint32_t y) const {
        return planes_.data() + level.begin + (size_t(channel) * level.height + y) * level.stride;
    }
    float* row(const Level& level, int channel, uint32_t y) {
        return planes_.data() + level.begin + (size_t(channel) * level.height + y) * level.stride;
    }
    // Rows of twice a level's height, of `count` columns from x on.
    template <class Sums>
    void double_rows(const Kernels& kernels, const Level& level, int channel, uint32_t y,
                     uint32_t x, uint32_t count, Sums& sums) const;

    OverBright bright_;
    Extent extent_; // of the picture
    uint32_t count_ = 0;
    Level levels_[kMostLevels];
    accel::Buffer<float> planes_;
};

} // namespace peregrine::render::post

namespace peregrine::render {

// A stage: takes the tile's colours from the film, after their light has spread.
void take_spread_light(const Plan& plan, TileBuffers& buffers);

} // namespace peregrine::render
