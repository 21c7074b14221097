#pragma once

#include "render/frame.h"

#include <algorithm>
#include <cstdint>

namespace peregrine::render {

inline constexpr uint32_t kTileSize = 32;
inline constexpr uint32_t kTileRays = kTileSize * kTileSize;
inline constexpr uint32_t kTilePadded = kTileRays + 16;

// A part of the image and the order of its rays: along Morton's curve, so that any 4, 16, 64, 256
// rays from a multiple of that on are a square of pixels (in tiles that are not cut by the image's
// edge; there the pixels outside are left out).
struct Tile {
    uint32_t x0, y0; // its first pixel
    uint32_t count;  // of rays
    uint8_t x[kTileRays];
    uint8_t y[kTileRays];

    void place(uint32_t index, uint32_t width, uint32_t height) {
        const uint32_t columns = (width + kTileSize - 1) / kTileSize;
        x0 = index % columns * kTileSize;
        y0 = index / columns * kTileSize;
        const uint32_t w = std::min(width - x0, kTileSize), h = std::min(height - y0, kTileSize);
        if (count == kTileRays && w * h == kTileRays) return; // still in order
        count = 0;
        for (uint32_t i = 0; i < kTileRays; ++i) {
            const uint32_t px = every_other_bit(i), py = every_other_bit(i >> 1);
            if (px >= w || py >= h) continue;
            x[count] = uint8_t(px);
            y[count] = uint8_t(py);
            ++count;
        }
    }

    static uint32_t tile_count(uint32_t width, uint32_t height) {
        return (width + kTileSize - 1) / kTileSize * ((height + kTileSize - 1) / kTileSize);
    }

private:
    static uint32_t every_other_bit(uint32_t i) {
        return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4) | (i >> 3 & 8) | (i >> 4 & 16);
    }
};

// A tile's colours, one ray after the other.
struct alignas(64) TileColors {
    float channel[3][kTilePadded];
};

} // namespace peregrine::render
