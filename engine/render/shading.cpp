#include "render/shading.h"

#include "render/tile_blocks.h"

#include <algorithm>

namespace peregrine::render {
void keep_light(const shade::RayHits& hits, uint32_t first, TileBuffers& buffers) {
    for (int k = 0; k < 3; ++k)
        std::copy_n(buffers.scratch.light.irradiance[k], hits.count,
                    buffers.light->irradiance[k] + first);
}

void take_light(const Plan& plan, const shade::RayHits& hits, uint32_t first,
                TileBuffers& buffers) {
    const shade::TileLight& light = *buffers.light;
    shade::Illumination& out = buffers.scratch.light;
    const bool lobes = plan.shader.program() == shade::Program::highlight;
    for (int k = 0; k < 3; ++k) {
        std::copy_n(light.irradiance[k] + first, hits.count, out.irradiance[k]);
        if (lobes) std::copy_n(light.highlight[k] + first, hits.count, out.highlight[k]);
    }
}

void shade_tile(const Plan& plan, TileBuffers& buffers) {
    buffers.for_each_batch([&](const shade::RayHits& hits, uint32_t first) {
        plan.shader.shade(hits, buffers.colors_from(first).channel, buffers.scratch,
                          buffers.openness_from(first));
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
        const TileBuffers::Channels colors = buffers.colors_from(first);
        plan.fog.veil(clear, hits.count, colors.channel);
        if (plan.airlight.any()) plan.airlight.add(hits, colors.channel, buffers.scratch);
    });
}

void hide_in_fog(const Plan& plan, TileBuffers& buffers) {
    hide_in_fog(plan, buffers, buffers.tile.count);
}

void find_light(const Plan& plan, TileBuffers& buffers) {
    shade::TileLight& light = *buffers.light;
    light.begin(buffers.tile.count);
    BlockLister(buffers.tile, plan.frame.approximations.light_block, light.blocks,
                [&](uint32_t ray) { light.want_whole(ray, shade::Block::kNothing); });
    plan.block_light.find(buffers.tile_hits(), light, buffers.scratch);
    buffers.light_point_count += light.point_count;
}

void shade_blocks(const Plan& plan, TileBuffers& buffers) {
    find_light(plan, buffers);
    buffers.for_each_batch([&](const shade::RayHits& hits, uint32_t first) {
        plan.shader.find_surfaces(hits, plan.shader.part_beside_light(), buffers.scratch);
        take_light(plan, hits, first, buffers);
        plan.shader.take_surroundings(hits, buffers.openness_from(first), buffers.scratch);
        plan.shader.find_radiance(hits, buffers.colors_from(first).channel, buffers.scratch);
    });
}

} // namespace peregrine::render
