#pragma once

#include "render/tile.h"
#include "shade/blocks/block_lists.h"

#include <algorithm>
#include <cstdint>

namespace peregrine::render {

// Lists the whole blocks of a tile, of a side where there is room, and calls alone(ray) for the
// rays of none.
template <class Alone>
class BlockLister {
public:
    BlockLister(const Tile& tile, uint32_t side, shade::BlockLists& lists, Alone alone)
        : tile_(tile), most_(side), lists_(lists), alone_(alone) {
        list(0, 0, kTileSize);
    }

private:
    void list(uint32_t x, uint32_t y, uint32_t side) {
        if (x >= tile_.width() || y >= tile_.height()) return;
        const uint32_t w = std::min(side, tile_.width() - x),
                       h = std::min(side, tile_.height() - y);
        if (w == side && h == side && side <= most_) {
            lists_.add({uint16_t(first_), uint8_t(side)});
            first_ += side * side;
        } else if (side > shade::Block::kLeast) {
            const uint32_t half = side / 2;
            for (uint32_t k = 0; k < 4; ++k) list(x + (k & 1) * half, y + (k >> 1) * half, half);
        } else {
            for (const uint32_t end = first_ + w * h; first_ < end; ++first_) alone_(first_);
        }
    }

    const Tile& tile_;
    uint32_t most_;
    shade::BlockLists& lists_;
    Alone alone_;
    uint32_t first_ = 0;
};

} // namespace peregrine::render
