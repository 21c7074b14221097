#include "render/shading.h"

namespace peregrine::render {

void shade_tile(const Plan& plan, TileBuffers& buffers) {
    buffers.for_each_batch([&](const shade::RayHits& hits, uint32_t first) {
        plan.shader.shade(hits, buffers.colors_from(first).channel, buffers.scratch);
    });
}

} // namespace peregrine::render
