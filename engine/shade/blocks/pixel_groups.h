#pragma once

#include "shade/blocks/block.h"

#include <cmath>
#include <cstdint>

namespace peregrine::shade {

// The pixels of a block of the least side, by how far away they see something: those of one group
// are so near each other that they mostly see the same lights, whatever their normals are.
struct PixelGroups {
    static constexpr uint32_t kMost = 4;
    static constexpr uint8_t kNone = 0xff;
    static constexpr float kDepth = 1; // of a group, in sides of the block

    uint32_t count = 0;
    uint8_t first[kMost], last[kMost]; // pixels
    uint8_t of[Block::kLeast * Block::kLeast];

    // `pixel`: the side of a pixel at a distance of 1.
    PixelGroups(const float* t, float pixel) {
        float inverse[kMost];
        for (uint8_t i = 0; i < Block::kLeast * Block::kLeast; ++i) {
            const float here = 1.0f / t[i];
            uint32_t group = 0;
            while (group < count
                   && !(std::fabs(here - inverse[group])
                        <= kDepth * float(Block::kLeast) * pixel * inverse[group]))
                ++group;
            of[i] = group < kMost ? uint8_t(group) : kNone;
            if (group == kMost) continue;
            if (group == count) {
                inverse[count] = here;
                first[count++] = i;
            }
            last[group] = i;
        }
    }
};

} // namespace peregrine::shade
