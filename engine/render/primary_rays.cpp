#include "render/primary_rays.h"

#include "trace/world/stream.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace peregrine::render {

static_assert(kTileSize == trace::ImageTile::kSide);
static_assert(kTileRays <= trace::kMaxStream);

namespace {

// Sums of a column's and a row's value for the rays of a whole tile, of which any eight from a
// multiple of eight on are two rows of four pixels, pair by pair.
void fill_whole(const float* across, const float* down, float* sums) {
    constexpr size_t kPair = 2 * sizeof(float);
    for (uint32_t y = 0; y < kTileSize; y += 2) {
        float upper[kTileSize], lower[kTileSize];
        for (uint32_t x = 0; x < kTileSize; ++x) {
            upper[x] = across[x] + down[y];
            lower[x] = across[x] + down[y + 1];
        }
        for (uint32_t x = 0; x < kTileSize; x += 4) {
            float* const eight = sums + Tile::ray_of(x, y);
            std::memcpy(eight, upper + x, kPair);
            std::memcpy(eight + 2, lower + x, kPair);
            std::memcpy(eight + 4, upper + x + 2, kPair);
            std::memcpy(eight + 6, lower + x + 2, kPair);
        }
    }
}

// The operations of Pinhole::direction, of which all but a sum are those of a column or a row.
void make_rays(const Pinhole& pinhole, TileBuffers& buffers) {
    const Tile& tile = buffers.tile;
    for (int k = 0; k < 3; ++k) {
        float across[kTileSize], down[kTileSize];
        for (uint32_t i = 0; i < kTileSize; ++i) {
            across[i] = pinhole.corner[k] + pinhole.right[k] * (float(int32_t(tile.x0 + i)) + 0.5f);
            down[i] = pinhole.down[k] * (float(int32_t(tile.y0 + i)) + 0.5f);
        }
        float* const direction = buffers.direction[k];
        if (tile.is_whole())
            fill_whole(across, down, direction);
        else
            for (uint32_t i = 0; i < tile.count; ++i)
                direction[i] = across[tile.x[i]] + down[tile.y[i]];
        std::fill_n(direction + tile.count, kTilePadded - kTileRays, direction[tile.count - 1]);
    }
}

} // namespace

void begin_primary_rays(const Plan& plan, TileBuffers& buffers) {
    for (int k = 0; k < 3; ++k) std::fill_n(buffers.origin[k], kTilePadded, plan.pinhole.origin[k]);
    std::fill_n(buffers.t_max, kTilePadded, std::numeric_limits<float>::infinity());
    const bool by_footprint = plan.frame.approximations.texture_filter == TextureFilter::mipmaps;
    buffers.footprint = by_footprint ? plan.pinhole.pixel_width : 0;
}

void trace_primary_rays(const Plan& plan, TileBuffers& buffers) {
    make_rays(plan.pinhole, buffers);
    const auto& [ox, oy, oz] = buffers.origin;
    const auto& [dx, dy, dz] = buffers.direction;
    const bool count_steps = plan.frame.view == View::steps;
    const Pinhole& pinhole = plan.pinhole;
    const trace::ImageTile image = {pinhole.corner, pinhole.right, pinhole.down, buffers.tile.x0,
                                    buffers.tile.y0};
    const trace::RayStream rays = {{ox, oy, oz},
                                   {dx, dy, dz},
                                   buffers.t_min,
                                   buffers.t_max,
                                   buffers.tile.count,
                                   trace::Coherence::common_origin,
                                   buffers.tile.is_whole() && !count_steps ? &image : nullptr};
    // All begin at the eye, and these are zeros.
    const trace::Positions positions = {{buffers.t_min, buffers.t_min, buffers.t_min}, plan.eye};
    trace::closest(plan.snapshot.world, rays, positions, plan.filter,
                   {buffers.t, buffers.u, buffers.v, buffers.triangle, buffers.back_face,
                    count_steps ? buffers.steps : nullptr});
}

} // namespace peregrine::render
