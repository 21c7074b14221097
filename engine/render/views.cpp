#include "render/views.h"

#include <algorithm>
#include <cmath>

namespace peregrine::render {

void show_normals(const shade::RayHits& hits, const shade::Surface& surface,
                  float* const colors[3]) {
    for (uint32_t k = 0; k < 3; ++k)
        for (uint32_t i = 0; i < hits.count; ++i)
            colors[k][i] = hits.triangle[i] == geometry::kNoTriangle
                               ? 0.0f
                               : 0.5f * surface.normal[k][i] + 0.5f;
}

void show_depth(const shade::RayHits& hits, const float* t, float range, float* const colors[3]) {
    for (uint32_t i = 0; i < hits.count; ++i) {
        const math::Vec3 d(hits.direction[0][i], hits.direction[1][i], hits.direction[2][i]);
        const bool hit = hits.triangle[i] != geometry::kNoTriangle;
        const float distance = t[i] * std::sqrt(glm::dot(d, d));
        const float value = hit ? std::max(0.0f, 1.0f - distance / range) : 0.0f;
        colors[0][i] = colors[1][i] = colors[2][i] = value;
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

void show_steps(const uint32_t* steps, uint32_t count, float range, float* const colors[3]) {
    for (uint32_t i = 0; i < count; ++i) {
        const math::Vec3 color = heat(float(steps[i]) / range);
        for (int k = 0; k < 3; ++k) colors[k][i] = color[k];
    }
}

} // namespace peregrine::render
