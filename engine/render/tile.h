#pragma once

#include "render/frame.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

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
        width_ = w;
        height_ = h;
        if (is_whole() && w * h == kTileRays) return; // still in order
        count = 0;
        for (uint32_t i = 0; i < kTileRays; ++i) {
            const uint32_t px = every_other_bit(i), py = every_other_bit(i >> 1);
            if (px >= w || py >= h) continue;
            x[count] = uint8_t(px);
            y[count] = uint8_t(py);
            ++count;
        }
    }

    uint32_t width() const { return width_; } // pixels
    uint32_t height() const { return height_; }
    bool is_whole() const { return count == kTileRays; }

    // The ray of a pixel of a whole tile.
    static constexpr uint32_t ray_of(uint32_t px, uint32_t py) {
        return apart(px) | apart(py) << 1;
    }

    static uint32_t tile_count(uint32_t width, uint32_t height) {
        return (width + kTileSize - 1) / kTileSize * ((height + kTileSize - 1) / kTileSize);
    }

private:
    uint32_t width_, height_;

    static constexpr uint32_t apart(uint32_t i) {
        return (i & 1) | (i & 2) << 1 | (i & 4) << 2 | (i & 8) << 3 | (i & 16) << 4;
    }
    static uint32_t every_other_bit(uint32_t i) {
        return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4) | (i >> 3 & 8) | (i >> 4 & 16);
    }
};

// A tile's colours, one ray after the other.
struct alignas(64) TileColors {
    float channel[3][kTilePadded];
};

// Copies values of a tile's rays to the rows of an image whose first pixel is at `image`. Of a
// whole tile row by row: rows are often a multiple of 4 KiB apart, and then share a few places of
// the cache.
template <class Element>
void store_tile(const Tile& tile, const Element* values, void* image, uint64_t row_stride) {
    std::byte* const corner =
        static_cast<std::byte*>(image) + tile.y0 * row_stride + tile.x0 * sizeof(Element);
    if (!tile.is_whole()) {
        for (uint32_t i = 0; i < tile.count; ++i)
            std::memcpy(corner + tile.y[i] * row_stride + tile.x[i] * sizeof(Element), values + i,
                        sizeof(Element));
        return;
    }
    constexpr size_t kPair = 2 * sizeof(Element);
    for (uint32_t y = 0; y < kTileSize; y += 2)
        for (uint32_t x = 0; x < kTileSize; x += 4) {
            // Eight rays are two rows of four pixels, pair by pair.
            const Element* eight = values + Tile::ray_of(x, y);
            std::byte* const place = corner + y * row_stride + x * sizeof(Element);
            std::memcpy(place, eight, kPair);
            std::memcpy(place + kPair, eight + 4, kPair);
            std::memcpy(place + row_stride, eight + 2, kPair);
            std::memcpy(place + row_stride + kPair, eight + 6, kPair);
        }
}

} // namespace peregrine::render
