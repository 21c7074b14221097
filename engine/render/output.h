#pragma once

#include "render/frame.h"
#include "render/tile.h"

namespace peregrine::render {

// From radiance to the caller's pixels, chosen once a frame.
struct Output {
    void (*map_tones)(float exposure, uint32_t count, TileColors& colors);
    void (*write)(const Frame& frame, const Tile& tile, const TileColors& colors);

    static Output choose(const Frame& frame);
};

} // namespace peregrine::render
