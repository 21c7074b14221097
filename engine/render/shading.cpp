#include "render/shading.h"

#include "render/tile_blocks.h"

#include <algorithm>

namespace peregrine::render {
void shade_tile(const Plan& plan, TileBuffers& buffers) {
    buffers.for_each_batch([&](const shade::RayHits& hits, uint32_t first) {
        const float* const openness =
            buffers.openness ? buffers.openness->openness + first : nullptr;
        plan.shader.shade(hits, buffers.colors_from(first).channel, buffers.scratch, openness);
        if (!plan.frame.looks_for_edges()) return;
        for (int k = 0; k < 3; ++k)
            std::copy_n(buffers.scratch.light.irradiance[k], hits.count,
                        buffers.light->irradiance[k] + first);
    });
    buffers.light_point_count += buffers.tile.count;
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
    const shade::TileLight& light = *buffers.light;
    shade::Scratch& scratch = buffers.scratch;
    const bool lobes = plan.shader.program() == shade::Program::highlight;
    buffers.for_each_batch([&](const shade::RayHits& hits, uint32_t first) {
        plan.shader.find_surfaces(hits, shade::SurfacePart::colors, scratch);
        for (int k = 0; k < 3; ++k) {
            std::copy_n(light.irradiance[k] + first, hits.count, scratch.light.irradiance[k]);
            if (lobes)
                std::copy_n(light.highlight[k] + first, hits.count, scratch.light.highlight[k]);
        }
        if (buffers.openness)
            std::copy_n(buffers.openness->openness + first, hits.count, scratch.light.openness);
        plan.shader.find_radiance(hits, buffers.colors_from(first).channel, scratch);
    });
}

} // namespace peregrine::render
