#include "render/post/edge_rays.h"

#include "render/bounces.h"
#include "render/film.h"
#include "render/post/bloom.h"
#include "render/post/kernels.h"
#include "render/post/shown.h"
#include "render/primary_rays.h"
#include "render/shading.h"

#include <algorithm>
#include <cmath>

namespace peregrine::render::post {
namespace {

struct Pixel {
    uint32_t x, y;
};

// A sunflower's seeds (Vogel 1979): any number of them covers a disk evenly, and no two share a row
// or column. The disk has a pixel's area.
constexpr double kDiskRadius = 0.5641895835477563;
constexpr double kGoldenCosine = -0.7373688780783197, kGoldenSine = 0.6754902942615238;

// Rays through a few pixels of a tile, one pixel after the other.
class EdgeBatch {
public:
    EdgeBatch(const Plan& plan, const EdgePattern& pattern, TileBuffers& buffers)
        : plan_(plan), pattern_(pattern), buffers_(buffers), most_(kTileRays / pattern.count) {}

    void add(const Pixel& pixel) {
        pixels_[count_++] = pixel;
        if (count_ == most_) finish();
    }

    void finish() {
        if (count_ == 0) return;
        make_rays();
        const uint32_t ray_count = count_ * pattern_.count;
        trace_rays_from_eye(plan_, buffers_, ray_count, nullptr);
        shade(ray_count);
        if (plan_.particles) add_particles();
        if (plan_.bloom) spread_light(ray_count);
        const auto to_shown = kernels(plan_.snapshot.isa()).to_shown;
        for (float* const channel : buffers_.colors.channel)
            to_shown(plan_.frame.tone_mapping, plan_.frame.exposure, channel, ray_count, channel);
        for (uint32_t i = 0; i < count_; ++i) put_mean(i);
        buffers_.edge_ray_count += ray_count;
        buffers_.light_point_count += ray_count;
        count_ = 0;
    }

private:
    void make_rays() {
        const Pinhole& pinhole = plan_.pinhole;
        uint32_t ray = 0;
        for (uint32_t i = 0; i < count_; ++i)
            for (uint32_t k = 0; k < pattern_.count; ++k, ++ray) {
                const float x = float(pixels_[i].x) + (0.5f + pattern_.x[k]);
                const float y = float(pixels_[i].y) + (0.5f + pattern_.y[k]);
                const math::Vec3 direction =
                    (pinhole.corner + pinhole.right * x) + pinhole.down * y;
                for (int c = 0; c < 3; ++c) buffers_.direction[c][ray] = direction[c];
            }
        for (auto& lanes : buffers_.direction)
            std::fill_n(lanes + ray, kTilePadded - kTileRays, lanes[ray - 1]);
    }

    void shade(uint32_t ray_count) {
        const float part = std::sqrt(float(pattern_.count + 1)); // of the pixel
        if (buffers_.paths)
            return shade_rays_and_follow(plan_, buffers_, ray_count, 1 / part, nullptr);
        buffers_.for_each_batch(ray_count, [&](shade::RayHits hits, uint32_t first) {
            hits.footprint /= part;
            const TileBuffers::Channels colors = buffers_.colors_from(first);
            plan_.shader.shade(hits, colors.channel, buffers_.scratch);
            if (plan_.shader.has_sky()) plan_.shader.paint_sky(hits, colors.channel);
        });
        if (plan_.fog.any()) hide_in_fog(plan_, buffers_, ray_count);
    }

    // Their light is that of the pixel's centre.
    void add_particles() {
        Film& film = *plan_.film;
        for (uint32_t i = 0; i < count_; ++i)
            for (int c = 0; c < 3; ++c) {
                const float more = film.particles(c)[pixels_[i].y * film.stride() + pixels_[i].x];
                float* const rays = buffers_.colors.channel[c] + i * pattern_.count;
                for (uint32_t k = 0; k < pattern_.count; ++k) rays[k] += more;
            }
    }

    // A pixel's rays get what the pixel gets; each gives its own.
    void spread_light(uint32_t ray_count) {
        alignas(64) float glow[3][kTilePadded];
        float* light[3];
        for (int c = 0; c < 3; ++c) {
            light[c] = buffers_.colors.channel[c];
            for (uint32_t i = 0; i < ray_count; ++i) light[c][i] = sane_radiance(light[c][i]);
            std::fill_n(light[c] + ray_count, kTilePadded - kTileRays, 0.0f);
        }
        for (uint32_t i = 0; i < count_; ++i) {
            const math::Vec3 each = plan_.bloom->glow_at(pixels_[i].x, pixels_[i].y);
            for (int c = 0; c < 3; ++c)
                std::fill_n(glow[c] + i * pattern_.count, pattern_.count, each[c]);
        }
        for (auto& lanes : glow) std::fill_n(lanes + ray_count, kTilePadded - kTileRays, 0.0f);
        const float* const glows[3] = {glow[0], glow[1], glow[2]};
        kernels(plan_.snapshot.isa()).spread(plan_.bloom->over_bright(), glows, ray_count, light);
    }

    // Of display values, which is how the eye will mix them.
    void put_mean(uint32_t i) {
        Film& film = *plan_.film;
        const Pixel& pixel = pixels_[i];
        const size_t at = pixel.y * film.stride() + pixel.x;
        float mean[3];
        for (int c = 0; c < 3; ++c) {
            const float* const rays = buffers_.colors.channel[c] + i * pattern_.count;
            float sum = film.shown(c)[at] * film.shown(c)[at];
            for (uint32_t k = 0; k < pattern_.count; ++k) sum += rays[k] * rays[k];
            mean[c] = std::sqrt(sum / float(pattern_.count + 1));
            if (plan_.frame.is_enlarged()) film.shown(c)[at] = mean[c];
        }
        const float* const shown[3] = {mean, mean + 1, mean + 2};
        if (!plan_.frame.is_enlarged()) write_shown(plan_.frame, pixel.x, pixel.y, 1, shown);
    }

    const Plan& plan_;
    const EdgePattern& pattern_;
    TileBuffers& buffers_;
    uint32_t most_;
    uint32_t count_ = 0;
    Pixel pixels_[kTileRays];
};

} // namespace

EdgePattern::EdgePattern(uint32_t samples) : count(samples - 1) {
    double cosine = 1, sine = 0;
    for (uint32_t k = 0; k < count; ++k) {
        const double turned = cosine * kGoldenCosine - sine * kGoldenSine;
        sine = cosine * kGoldenSine + sine * kGoldenCosine;
        cosine = turned;
        const double radius = kDiskRadius * std::sqrt((k + 1.0) / (samples - 0.5));
        x[k] = float(radius * cosine);
        y[k] = float(radius * sine);
    }
}

void trace_tile_edges(const Plan& plan, const EdgePattern& pattern, uint32_t least_key,
                      TileBuffers& buffers) {
    const Tile& tile = buffers.tile;
    const uint16_t* const keys = plan.film->edge();
    EdgeBatch batch(plan, pattern, buffers);
    for (uint32_t i = 0; i < tile.count; ++i) {
        const Pixel pixel = {tile.x0 + tile.x[i], tile.y0 + tile.y[i]};
        if (keys[pixel.y * plan.film->stride() + pixel.x] >= least_key) batch.add(pixel);
    }
    batch.finish();
}

} // namespace peregrine::render::post
