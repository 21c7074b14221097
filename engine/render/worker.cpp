#include "render/worker.h"

#include "render/views.h"
#include "render/visibility.h"

#include <algorithm>
#include <limits>

namespace peregrine::render {

static_assert(kTilePadded * sizeof(float) % 64 == 0, "the kernels want aligned arrays");
static_assert(kTileRays % shade::kBatch == 0);

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

// The operations of Pinhole::direction, as loops over arrays.
void Worker::make_rays(const Pinhole& pinhole) {
    const auto x0 = int32_t(tile_.x0), y0 = int32_t(tile_.y0);
    for (int k = 0; k < 3; ++k) {
        const float corner = pinhole.corner[k], right = pinhole.right[k], down = pinhole.down[k];
        float* direction = direction_[k];
        for (uint32_t i = 0; i < tile_.count; ++i) {
            const float x = float(x0 + tile_.x[i]) + 0.5f, y = float(y0 + tile_.y[i]) + 0.5f;
            direction[i] = (corner + right * x) + down * y;
        }
        std::fill_n(direction + tile_.count, kTilePadded - kTileRays, direction[tile_.count - 1]);
    }
}

void Worker::trace(const FrameContext& context) {
    const trace::RayStream rays = {{origin_[0], origin_[1], origin_[2]},
                                   {direction_[0], direction_[1], direction_[2]},
                                   t_min_,
                                   t_max_,
                                   tile_.count,
                                   trace::Coherence::common_origin};
    const bool count_steps = context.frame.view == View::steps;
    context.snapshot.kernels->closest_stream(
        context.shader.target, rays, context.filter,
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
