#include "render/particles.h"

#include "render/film.h"
#include "render/plan.h"
#include "scene/alpha_test.h"
#include "trace/world/stream.h"

#include <algorithm>
#include <cmath>

namespace peregrine::render {
namespace {

constexpr double kLeastRadius = 1;            // pixels: smaller ones are as large, and dimmer
constexpr double kNearest = 1.0 / 64;         // radii before the eye
constexpr float kSteepest = 1e20f;            // by a metre
constexpr float kJustBelowOne = 1 - 0x1p-12f; // a surface that it touches doesn't hide it

// What the eye sees of a particle it sees through glass, too.
trace::Filter filter_of(const Plan& plan) {
    trace::Filter filter = plan.filter;
    filter.alpha = scene::light_test(plan.snapshot);
    filter.asks = trace::Asks::light;
    return filter;
}

} // namespace

// From places to pixels.
class Particles::View {
public:
    explicit View(const Plan& plan)
        : extent_(plan.extent), right_(plan.pinhole.right), down_(plan.pinhole.down) {
        middle_ = math::Vec3d(0.5 * extent_.width, 0.5 * extent_.height, 0);
        forward_ = math::Vec3d(plan.pinhole.corner) + right_ * middle_.x + down_ * middle_.y;
        across_ = glm::length(right_);
        along_ = glm::length(down_);
    }

    // Empty if nothing of it is within the picture.
    Box project(const Particle& particle, post::Sprite& sprite) const {
        const math::Vec3d place(particle.place);
        const double depth = glm::dot(place, forward_), radius = particle.radius;
        if (!(depth > kNearest * radius)) return {};
        const double x = middle_.x + glm::dot(place, right_) / (depth * across_ * across_);
        const double y = middle_.y + glm::dot(place, down_) / (depth * along_ * along_);
        const double width = radius / (depth * across_), height = radius / (depth * along_);
        const double wide = std::max(width, kLeastRadius), high = std::max(height, kLeastRadius);
        const Box box = {to_pixel(std::floor(x - wide), extent_.width),
                         to_pixel(std::floor(y - high), extent_.height),
                         to_pixel(std::ceil(x + wide), extent_.width),
                         to_pixel(std::ceil(y + high), extent_.height)};
        if (box.left >= box.right || box.top >= box.bottom) return {};
        const double near = std::min(depth / radius, 1.0);
        const double part = near * near * (width / wide) * (height / high);
        sprite.x = float(x);
        sprite.y = float(y);
        sprite.by_width = float(1 / wide);
        sprite.by_height = float(1 / high);
        sprite.depth = float(depth);
        sprite.by_depth = std::min(1 / particle.radius, kSteepest);
        sprite.color = particle.color * float(part);
        return box;
    }

private:
    static uint16_t to_pixel(double at, uint32_t count) {
        return uint16_t(at > 0 ? std::min(at, double(count)) : 0);
    }

    Extent extent_;
    math::Vec3d right_, down_, forward_, middle_;
    double across_, along_; // a pixel at depth 1
};

Particles::Particles(const Frame& frame, base::Memory* memory)
    : count_(uint32_t(frame.particles.size())), sprites_(memory), boxes_(memory), groups_(memory) {
    sprites_.allocate(count_);
    boxes_.allocate(count_);
    groups_.allocate((count_ + kGroup - 1) / kGroup);
}

void Particles::find(const Plan& plan, uint32_t share, TileBuffers& buffers) {
    const View view(plan);
    const uint32_t first = share * kShare, end = std::min(first + kShare, count_);
    uint32_t index[kShare];
    uint32_t count = 0;
    for (uint32_t i = first; i < end; ++i) {
        const Particle& particle = plan.frame.particles[i];
        boxes_[i] = view.project(particle, sprites_[i]);
        if (boxes_[i].left >= boxes_[i].right) continue;
        for (int k = 0; k < 3; ++k) buffers.direction[k][count] = particle.place[k];
        index[count++] = i;
    }
    if (count > 0) {
        look_at(plan, index, count, buffers);
        if (plan.fog.any()) dim(plan, index, count, buffers);
    }
    for (uint32_t i = first; i < end; i += kGroup) {
        Box group;
        for (uint32_t k = i; k < std::min(i + kGroup, end); ++k) group.extend(boxes_[k]);
        groups_[i / kGroup] = group;
    }
}

// The ray to each is in the buffers. Empties the boxes of those that are hidden.
void Particles::look_at(const Plan& plan, const uint32_t* index, uint32_t count,
                        TileBuffers& buffers) {
    for (auto& lanes : buffers.direction)
        std::fill(lanes + count, lanes + kTilePadded, lanes[count - 1]);
    std::fill_n(buffers.t, kTilePadded, kJustBelowOne);
    const auto& [ox, oy, oz] = buffers.origin;
    const auto& [dx, dy, dz] = buffers.direction;
    const trace::RayStream rays = {{ox, oy, oz}, {dx, dy, dz}, buffers.t_min,
                                   buffers.t,    count,        trace::Coherence::automatic};
    // All begin at the eye, and these are zeros.
    const trace::Positions positions = {{buffers.t_min, buffers.t_min, buffers.t_min}, plan.eye};
    alignas(64) uint8_t occluded[kTilePadded];
    trace::occluded(plan.snapshot.world, rays, positions, filter_of(plan), occluded);
    buffers.particle_ray_count += count;
    for (uint32_t k = 0; k < count; ++k)
        if (occluded[k]) boxes_[index[k]] = {};
}

void Particles::dim(const Plan& plan, const uint32_t* index, uint32_t count, TileBuffers& buffers) {
    alignas(64) shade::Surface::Lanes clear;
    const auto& [dx, dy, dz] = buffers.direction;
    for (uint32_t first = 0; first < count; first += shade::kBatch) {
        const uint32_t some = std::min(count - first, shade::kBatch);
        const float* const directions[3] = {dx + first, dy + first, dz + first};
        plan.fog.find_clear(directions, buffers.t + first, some, clear);
        for (uint32_t k = 0; k < some; ++k) sprites_[index[first + k]].color *= clear[k];
    }
}

void add_particles(const Plan& plan, TileBuffers& buffers) {
    const Tile& tile = buffers.tile;
    const auto add_sprite = post::kernels(plan.snapshot.isa()).add_sprite;
    alignas(64) float depth[kTileRays], light[3][kTileRays]; // row by row
    float* const sums[3] = {light[0], light[1], light[2]};
    const auto at = [&](uint32_t i) { return tile.y[i] * kTileSize + tile.x[i]; };
    bool any = false;
    const auto begin = [&] {
        any = true;
        std::fill_n(depth, kTileRays, 0.0f);
        std::fill_n(light[0], 3 * kTileRays, 0.0f);
        for (uint32_t i = 0; i < tile.count; ++i) depth[at(i)] = buffers.t[i];
    };
    const auto draw = [&](const post::Sprite& sprite, const post::SpriteArea& area) {
        if (!any) begin();
        add_sprite(sprite, area, depth, sums);
    };
    plan.particles->for_each_in(tile, draw);
    if (any)
        for (int k = 0; k < 3; ++k)
            for (uint32_t i = 0; i < tile.count; ++i)
                buffers.colors.channel[k][i] += light[k][at(i)];
    if (!plan.frame.looks_for_edges()) return;
    if (!any) std::fill_n(light[0], 3 * kTileRays, 0.0f);
    Film& film = *plan.film;
    for (int k = 0; k < 3; ++k)
        for (uint32_t y = 0; y < tile.height(); ++y)
            std::copy_n(light[k] + y * kTileSize, tile.width(),
                        film.particles(k) + (tile.y0 + y) * film.stride() + tile.x0);
}

} // namespace peregrine::render
