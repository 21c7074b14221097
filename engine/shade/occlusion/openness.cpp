#include "shade/occlusion/openness.h"

#include "shade/surface/ray_hits.h"

#include <algorithm>
#include <cmath>

namespace peregrine::shade {

Openness::Openness(const scene::Snapshot& snapshot, const SurfaceSpace& space, float range,
                   uint32_t samples)
    : shadows_(snapshot, space), range_(range), rays_(samples, std::isfinite(range)) {}

void Openness::find(const RayHits& hits, const Surface& surface, ShadowMemory& shadow,
                    OpennessMemory& memory, float* openness) const {
    std::fill_n(openness, hits.count, 1.0f);
    const uint32_t count = list_points(hits, surface, shadow, memory);
    if (count == 0) return;
    std::fill_n(memory.open, count, 0u);
    for (const OpenRay& ray : rays_.all()) trace(ray, count, shadow, memory);
    const auto samples = float(rays_.all().size());
    for (uint32_t i = 0; i < count; ++i)
        openness[memory.point[i]] = float(memory.open[i]) / samples;
}

// Where rays begin, and which way the surface faces there.
uint32_t Openness::list_points(const RayHits& hits, const Surface& surface, ShadowMemory& shadow,
                               OpennessMemory& memory) const {
    uint32_t count = 0;
    math::Vec3 last(0);
    TangentFrame frame(last);
    for (uint32_t i = 0; i < hits.count; ++i) {
        if (hits.triangle[i] == geometry::kNoTriangle) continue;
        const math::Vec3 normal(surface.normal[0][i], surface.normal[1][i], surface.normal[2][i]);
        if (normal != last) frame = TangentFrame(normal);
        last = normal;
        for (int k = 0; k < 3; ++k) {
            shadow.origin[k][count] = surface.position[k][i];
            memory.geometric[k][count] = surface.geometric[k][i];
            memory.axis[0][k][count] = frame.x[k];
            memory.axis[1][k][count] = frame.y[k];
            memory.axis[2][k][count] = normal[k];
        }
        memory.point[count++] = i;
    }
    return count;
}

// Where normals are interpolated, a ray may go down into its triangle: that mirrors it.
void Openness::aim(const OpenRay& ray, uint32_t count, ShadowMemory& shadow,
                   const OpennessMemory& memory) const {
    const auto& [x, y, z] = memory.axis;
    const auto& [gx, gy, gz] = memory.geometric;
    auto& [dx, dy, dz] = shadow.direction;
    for (int k = 0; k < 3; ++k)
        for (uint32_t i = 0; i < count; ++i)
            shadow.direction[k][i] =
                (x[k][i] * ray.direction.x + y[k][i] * ray.direction.y) + z[k][i] * ray.direction.z;
    for (uint32_t i = 0; i < count; ++i) {
        const float rise = (gx[i] * dx[i] + gy[i] * dy[i]) + gz[i] * dz[i];
        const float back = 2 * std::min(rise, 0.0f);
        dx[i] -= back * gx[i];
        dy[i] -= back * gy[i];
        dz[i] -= back * gz[i];
    }
}

void Openness::trace(const OpenRay& ray, uint32_t count, ShadowMemory& shadow,
                     OpennessMemory& memory) const {
    aim(ray, count, shadow, memory);
    std::fill_n(memory.length, count, range_ * ray.length);
    shadows_.trace_any({{shadow.origin[0], shadow.origin[1], shadow.origin[2]},
                        {shadow.direction[0], shadow.direction[1], shadow.direction[2]},
                        shadow.zeros,
                        memory.length,
                        count,
                        trace::Coherence::incoherent},
                       shadow);
    memory.ray_count += count;
    for (uint32_t i = 0; i < count; ++i)
        memory.open[i] += shadow.occluded[i] == ShadowMemory::kFree;
}

} // namespace peregrine::shade
