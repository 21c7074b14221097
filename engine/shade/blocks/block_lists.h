#pragma once

#include "shade/blocks/block.h"

#include <cstdint>

namespace peregrine::shade {

inline constexpr uint32_t kMostTileRays = 1024;

// The blocks of a tile that are still to be tried.
struct BlockLists {
    struct List {
        Block blocks[kMostTileRays / (Block::kLeast * Block::kLeast)];
        uint32_t count;

        void add(const Block& block) { blocks[count++] = block; }
    };
    static constexpr uint32_t kLevels = 3;

    List pending[kLevels]; // by log2(side) - 2
    List uneven;           // of the least side, that are not to be interpolated

    static uint32_t level_of(uint32_t side) { return side == 4 ? 0 : side == 8 ? 1 : 2; }

    void clear() {
        for (List& list : pending) list.count = 0;
        uneven.count = 0;
    }
    void add(const Block& block) { pending[level_of(block.side)].add(block); }
    // Its quarters are to be tried instead.
    void cut(const Block& block) {
        if (block.side == Block::kLeast) return uneven.add(block);
        for (uint32_t k = 0; k < 4; ++k) add(block.quarter(k));
    }
};

// What lies in the middle of a block if it is interpolated from the corners.
inline float between_corners(const float* values, const Block& block) {
    const float x = (0.5f * float(block.side) - 1.0f) / float(block.side - 1);
    const float a = values[block.sample(0)], b = values[block.sample(1)];
    const float c = values[block.sample(2)], d = values[block.sample(3)];
    const float upper = a + (b - a) * x, lower = c + (d - c) * x;
    return upper + (lower - upper) * x;
}

// Whether the normals at a block's corners are like that in its middle, whose zero is like all.
inline bool normals_agree(const float* const normal[3], const Block& block, float least_cosine) {
    const uint32_t middle = block.sample(Block::kMiddle);
    const float x = normal[0][middle], y = normal[1][middle], z = normal[2][middle];
    if (x == 0 && y == 0 && z == 0) return true;
    for (uint32_t k = 0; k < Block::kMiddle; ++k) {
        const uint32_t i = block.sample(k);
        const float cosine = normal[0][i] * x + normal[1][i] * y + normal[2][i] * z;
        if (!(cosine >= least_cosine)) return false;
    }
    return true;
}

} // namespace peregrine::shade
