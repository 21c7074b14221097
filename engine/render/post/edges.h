#pragma once

#include "render/film.h"
#include "render/tile.h"

#include <cstdint>
#include <span>

namespace peregrine::render::post {

// An edge's key: its strength, and below that a number of the pixel's own, so that a budget that
// ends among equal edges takes some of them everywhere. 0: no edge.
inline constexpr uint32_t kEdgeNumberBits = 6;
inline constexpr uint32_t kEdgeKeys = 256u << kEdgeNumberBits;

struct EdgeCounts {
    uint32_t of_key[kEdgeKeys];
};

// Finds the keys of a tile's pixels on the plan's film, and counts them.
void find_tile_edges(const Plan& plan, const Tile& tile, EdgeCounts& counts);

// The smallest key from which on there are at most `most` edges.
uint32_t least_key(std::span<const EdgeCounts> counts, uint64_t most);

} // namespace peregrine::render::post
