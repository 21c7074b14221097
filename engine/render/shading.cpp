#include "render/shading.h"

#include "shade/blocks/block_light.h"

#include <algorithm>

namespace peregrine::render {
namespace {

using shade::Block;
using shade::TileLight;

// Lists the whole blocks of a tile from a side on, and wants the rays of none.
class BlockLister {
public:
    BlockLister(const Tile& tile, TileLight& light) : tile_(tile), light_(light) {}

    void list(uint32_t x, uint32_t y, uint32_t side) {
        if (x >= tile_.width() || y >= tile_.height()) return;
        const uint32_t w = std::min(side, tile_.width() - x),
                       h = std::min(side, tile_.height() - y);
        if (w == side && h == side && side <= most_) {
            light_.pending[TileLight::level_of(side)].add({uint16_t(first_), uint8_t(side)});
            first_ += side * side;
        } else if (side > Block::kLeast) {
            const uint32_t half = side / 2;
            for (uint32_t k = 0; k < 4; ++k) list(x + (k & 1) * half, y + (k >> 1) * half, half);
        } else {
            for (const uint32_t end = first_ + w * h; first_ < end; ++first_)
                light_.want_whole(first_, Block::kNothing);
        }
    }

    void list_all(uint32_t most) {
        most_ = most;
        list(0, 0, kTileSize);
    }

private:
    const Tile& tile_;
    TileLight& light_;
    uint32_t most_ = 0;
    uint32_t first_ = 0;
};

} // namespace

void keep_light(const shade::RayHits& hits, uint32_t first, TileBuffers& buffers) {
    for (int k = 0; k < 3; ++k)
        std::copy_n(buffers.scratch.light.irradiance[k], hits.count,
                    buffers.light->irradiance[k] + first);
}

void take_light(const Plan& plan, const shade::RayHits& hits, uint32_t first,
                TileBuffers& buffers) {
    const TileLight& light = *buffers.light;
    shade::Illumination& out = buffers.scratch.light;
    const bool lobes = plan.shader.program() == shade::Program::highlight;
    for (int k = 0; k < 3; ++k) {
        std::copy_n(light.irradiance[k] + first, hits.count, out.irradiance[k]);
        if (lobes) std::copy_n(light.highlight[k] + first, hits.count, out.highlight[k]);
    }
}

void shade_tile(const Plan& plan, TileBuffers& buffers) {
    buffers.for_each_batch([&](const shade::RayHits& hits, uint32_t first) {
        plan.shader.shade(hits, buffers.colors_from(first).channel, buffers.scratch);
        if (plan.frame.looks_for_edges()) keep_light(hits, first, buffers);
    });
    buffers.light_point_count += buffers.tile.count;
}

void paint_sky(const Plan& plan, TileBuffers& buffers) {
    buffers.for_each_batch([&](const shade::RayHits& hits, uint32_t first) {
        plan.shader.paint_sky(hits, buffers.colors_from(first).channel);
    });
}

void hide_in_fog(const Plan& plan, TileBuffers& buffers, uint32_t ray_count) {
    alignas(64) shade::Surface::Lanes clear;
    buffers.for_each_batch(ray_count, [&](const shade::RayHits& hits, uint32_t first) {
        plan.fog.find_clear(hits, clear);
        plan.fog.veil(clear, hits.count, buffers.colors_from(first).channel);
    });
}

void hide_in_fog(const Plan& plan, TileBuffers& buffers) {
    hide_in_fog(plan, buffers, buffers.tile.count);
}

void find_light(const Plan& plan, TileBuffers& buffers) {
    TileLight& light = *buffers.light;
    light.begin(buffers.tile.count);
    BlockLister(buffers.tile, light).list_all(plan.frame.approximations.light_block);
    const auto& [dx, dy, dz] = buffers.direction;
    plan.block_light.find({{dx, dy, dz},
                           buffers.t,
                           buffers.u,
                           buffers.v,
                           buffers.triangle,
                           buffers.back_face,
                           buffers.tile.count,
                           buffers.footprint},
                          light, buffers.scratch);
    buffers.light_point_count += light.point_count;
}

void shade_blocks(const Plan& plan, TileBuffers& buffers) {
    find_light(plan, buffers);
    buffers.for_each_batch([&](const shade::RayHits& hits, uint32_t first) {
        plan.shader.find_surfaces(hits, shade::SurfacePart::colors, buffers.scratch);
        take_light(plan, hits, first, buffers);
        plan.shader.find_radiance(hits, buffers.colors_from(first).channel, buffers.scratch);
    });
}

} // namespace peregrine::render
