#include "render/occlusion.h"

#include "render/tile_blocks.h"

namespace peregrine::render {

void find_openness(const Plan& plan, TileBuffers& buffers) {
    shade::TileOpenness& openness = *buffers.openness;
    openness.begin(buffers.tile.count);
    BlockLister(buffers.tile, plan.frame.occlusion.block, openness.blocks,
                [&](uint32_t ray) { openness.want(ray); });
    plan.block_openness.find(buffers.tile_hits(), openness, buffers.scratch);
}

void show_openness(const Plan& plan, TileBuffers& buffers) {
    auto& [red, green, blue] = buffers.colors.channel;
    const shade::TileOpenness* const openness = buffers.openness;
    const bool in_blocks = plan.frame.occlusion.block > 1;
    for (uint32_t i = 0; i < buffers.tile.count; ++i) {
        const bool seen = buffers.triangle[i] != geometry::kNoTriangle;
        const float open = !seen ? 0.0f : openness ? openness->openness[i] : 1.0f;
        const bool asked = seen && in_blocks && openness && openness->found[i]
                           && !(plan.shader.recalls_openness() && openness->recalled[i]);
        red[i] = asked ? 1.0f : open;
        green[i] = blue[i] = asked ? 0.25f * open : open;
    }
}

} // namespace peregrine::render
