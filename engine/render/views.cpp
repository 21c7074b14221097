#include "render/views.h"

#include "render/shading.h"

#include <algorithm>
#include <cmath>

namespace peregrine::render {

void show_normals(const Plan& plan, TileBuffers& buffers) {
    buffers.for_each_batch([&](const shade::RayHits& hits, uint32_t first) {
        plan.shader.find_surfaces(hits, shade::SurfacePart::geometry, buffers.scratch);
        for (uint32_t k = 0; k < 3; ++k)
            for (uint32_t i = 0; i < hits.count; ++i)
                buffers.colors.channel[k][first + i] =
                    hits.triangle[i] == geometry::kNoTriangle
                        ? 0.0f
                        : 0.5f * buffers.scratch.surface.normal[k][i] + 0.5f;
    });
}

void show_depth(const Plan& plan, TileBuffers& buffers) {
    const auto& [dx, dy, dz] = buffers.direction;
    auto& [red, green, blue] = buffers.colors.channel;
    for (uint32_t i = 0; i < buffers.tile.count; ++i) {
        const math::Vec3 d(dx[i], dy[i], dz[i]);
        const bool hit = buffers.triangle[i] != geometry::kNoTriangle;
        const float distance = buffers.t[i] * std::sqrt(glm::dot(d, d));
        const float value = hit ? std::max(0.0f, 1.0f - distance / plan.frame.depth_range) : 0.0f;
        red[i] = green[i] = blue[i] = value;
    }
}

math::Vec3 heat(float fraction) {
    static constexpr float kStops[5][3] = {{0, 0, 1}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {1, 1, 1}};
    const float x = std::clamp(fraction, 0.0f, 1.0f) * 4.0f;
    const uint32_t stop = std::min(uint32_t(x), 3u);
    const float weight = x - float(stop);
    math::Vec3 color;
    for (int k = 0; k < 3; ++k)
        color[k] = kStops[stop][k] + (kStops[stop + 1][k] - kStops[stop][k]) * weight;
    return color;
}

void show_steps(const Plan& plan, TileBuffers& buffers) {
    for (uint32_t i = 0; i < buffers.tile.count; ++i) {
        const math::Vec3 color = heat(float(buffers.steps[i]) / plan.frame.steps_range);
        for (int k = 0; k < 3; ++k) buffers.colors.channel[k][i] = color[k];
    }
}

void show_light(const Plan& plan, TileBuffers& buffers) {
    find_light(plan, buffers);
    const shade::TileLight& light = *buffers.light;
    for (uint32_t i = 0; i < buffers.tile.count; ++i) {
        const bool seen = buffers.triangle[i] != geometry::kNoTriangle;
        const uint32_t how = !light.found[i] ? 2 : light.traced[i] ? 0 : 1;
        const float strength = how == 0 ? std::min(float(light.traced[i] + 1) / 9.0f, 1.0f) : 1.0f;
        for (uint32_t k = 0; k < 3; ++k)
            buffers.colors.channel[k][i] = seen && k == how ? strength : 0.0f;
    }
}

} // namespace peregrine::render
