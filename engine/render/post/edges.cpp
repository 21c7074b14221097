#include "render/post/edges.h"

#include "render/post/kernels.h"

#include <algorithm>

namespace peregrine::render::post {
namespace {

constexpr float kLeastStrength = 6; // of 255: weaker edges do not show
constexpr float kMostBend = 0.25f;  // pixels: what neighbours may be off a plane by, ...
constexpr float kRounding = 2e-6f;  // ... and what rounding makes of it
constexpr float kPi = 3.14159265f;

uint32_t number_of(uint32_t x, uint32_t y) {
    uint32_t bits = x * 0x8da6b343u ^ y * 0xd8163841u;
    bits = (bits ^ bits >> 15) * 0x2c1b3c6du;
    return bits >> (32 - kEdgeNumberBits);
}

EdgeRow row_of(const Plan& plan, uint32_t y) {
    Film& film = *plan.film;
    const size_t at = y * film.stride();
    const auto stride = ptrdiff_t(film.stride());
    const math::Vec3& ambient = plan.snapshot.environment.ambient;
    EdgeRow row;
    for (int k = 0; k < 3; ++k) row.shown[k] = film.shown(k) + at;
    row.nearness = film.nearness() + at;
    row.light = film.light() + at;
    row.look = film.look() + at;
    row.above = y > 0 ? -stride : 0;
    row.below = y + 1 < plan.extent.height ? stride : 0;
    row.width = plan.extent.width;
    row.most_bend = std::max(kMostBend * glm::length(plan.pinhole.down), kRounding);
    row.more_light = kPi * (0.25f * ambient.x + 0.5f * ambient.y + 0.25f * ambient.z);
    return row;
}

} // namespace

void find_tile_edges(const Plan& plan, const Tile& tile, EdgeCounts& counts) {
    const auto find = kernels(plan.snapshot.isa()).find_edges;
    for (uint32_t y = tile.y0; y < tile.y0 + tile.height(); ++y) {
        alignas(64) float strengths[kTileSize];
        find(row_of(plan, y), tile.x0, tile.width(), strengths);
        uint16_t* const keys = plan.film->edge() + y * plan.film->stride() + tile.x0;
        for (uint32_t i = 0; i < tile.width(); ++i) {
            uint32_t key = 0;
            if (strengths[i] >= kLeastStrength)
                key = std::min(uint32_t(strengths[i]), 255u) << kEdgeNumberBits
                      | number_of(tile.x0 + i, y);
            keys[i] = uint16_t(key);
            ++counts.of_key[key];
        }
    }
}

uint32_t least_key(std::span<const EdgeCounts> counts, uint64_t most) {
    uint64_t sum = 0;
    for (uint32_t key = kEdgeKeys; key-- > 1;) {
        for (const EdgeCounts& each : counts) sum += each.of_key[key];
        if (sum > most) return key + 1;
    }
    return 1;
}

} // namespace peregrine::render::post
