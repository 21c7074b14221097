#include "render/worker.h"

#include "render/views.h"
#include "render/visibility.h"
#include "trace/world/stream.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace peregrine::render {

static_assert(kTilePadded * sizeof(float) % 64 == 0, "the kernels want aligned arrays");
static_assert(kTileSize == trace::ImageTile::kSide);
static_assert(kTileRays % shade::kBatch == 0 && kTileRays <= trace::kMaxStream);

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

} // namespace

void Worker::begin(const FrameContext& context) {
    for (int k = 0; k < 3; ++k) std::fill_n(origin_[k], kTilePadded, context.pinhole.origin[k]);
    std::fill_n(t_max_, kTilePadded, std::numeric_limits<float>::infinity());
    scratch_.initialize();
}

void Worker::render(const FrameContext& context, uint32_t tile_index) {
    tile_.place(tile_index, context.frame.width, context.frame.height);
    make_rays(context.pinhole);
    trace(context);
    if (context.frame.wants_planes())
        write_planes(context.snapshot, context.frame, tile_, {t_, u_, v_, triangle_});
    if (!context.frame.pixels) return;
    for (uint32_t first = 0; first < tile_.count; first += shade::kBatch) show(context, first);
    context.output.map_tones(context.frame.exposure, tile_.count, colors_);
    context.output.write(context.frame, tile_, colors_);
}

// The operations of Pinhole::direction, of which all but a sum are those of a column or a row.
void Worker::make_rays(const Pinhole& pinhole) {
    for (int k = 0; k < 3; ++k) {
        float across[kTileSize], down[kTileSize];
        for (uint32_t i = 0; i < kTileSize; ++i) {
            across[i] =
                pinhole.corner[k] + pinhole.right[k] * (float(int32_t(tile_.x0 + i)) + 0.5f);
            down[i] = pinhole.down[k] * (float(int32_t(tile_.y0 + i)) + 0.5f);
        }
        float* const direction = direction_[k];
        if (tile_.is_whole())
            fill_whole(across, down, direction);
        else
            for (uint32_t i = 0; i < tile_.count; ++i)
                direction[i] = across[tile_.x[i]] + down[tile_.y[i]];
        std::fill_n(direction + tile_.count, kTilePadded - kTileRays, direction[tile_.count - 1]);
    }
}

void Worker::trace(const FrameContext& context) {
    const bool count_steps = context.frame.view == View::steps;
    const Pinhole& pinhole = context.pinhole;
    const trace::ImageTile image = {pinhole.corner, pinhole.right, pinhole.down, tile_.x0,
                                    tile_.y0};
    const trace::RayStream rays = {{origin_[0], origin_[1], origin_[2]},
                                   {direction_[0], direction_[1], direction_[2]},
                                   t_min_,
                                   t_max_,
                                   tile_.count,
                                   trace::Coherence::common_origin,
                                   tile_.is_whole() && !count_steps ? &image : nullptr};
    // All begin at the eye, and these are zeros.
    const trace::Positions positions = {{t_min_, t_min_, t_min_}, context.eye};
    trace::closest(context.snapshot.world, rays, positions, context.filter,
                   {t_, u_, v_, triangle_, back_face_, count_steps ? steps_ : nullptr});
}

void Worker::show(const FrameContext& context, uint32_t first) {
    const uint32_t count = std::min(tile_.count - first, shade::kBatch);
    const shade::RayHits hits = {
        {direction_[0] + first, direction_[1] + first, direction_[2] + first},
        u_ + first,
        v_ + first,
        triangle_ + first,
        back_face_ + first,
        count};
    float* const colors[3] = {colors_.channel[0] + first, colors_.channel[1] + first,
                              colors_.channel[2] + first};
    switch (context.frame.view) {
    case View::shaded:
        return context.shader.shade(hits, colors, scratch_);
    case View::normals:
        context.shader.find_surfaces(hits, scratch_);
        return show_normals(hits, scratch_.surface, colors);
    case View::depth:
        return show_depth(hits, t_ + first, context.frame.depth_range, colors);
    case View::steps:
        return show_steps(steps_ + first, count, context.frame.steps_range, colors);
    }
}

} // namespace peregrine::render
