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
    const auto is_wanted = [&](uint32_t i) { return openness[i] < 0; };
    for (uint32_t i = 0; i < hits.count; ++i)
        if (hits.triangle[i] == geometry::kNoTriangle) openness[i] = 1;
    memory.points.list(surface, hits.count, is_wanted, shadow.origin);
    find_free_parts(World::whole, shadow, memory);
    for (uint32_t i = 0; i < memory.points.count; ++i)
        openness[memory.points.index[i]] = memory.free_part[i];
}

void Openness::hide_by_moving(const RayHits& hits, const Surface& surface, ShadowMemory& shadow,
                              OpennessMemory& memory, float* openness) const {
    if (!shadows_.something_moves_near(surface.bounds, range_)) return;
    const auto is_wanted = [&](uint32_t i) {
        if (!(openness[i] > 0) || hits.triangle[i] == geometry::kNoTriangle) return false;
        const auto& [x, y, z] = surface.position;
        const math::Vec3 place(x[i], y[i], z[i]);
        return shadows_.something_moves_near({place, place}, range_);
    };
    memory.points.list(surface, hits.count, is_wanted, shadow.origin);
    find_free_parts(World::moving, shadow, memory);
    for (uint32_t i = 0; i < memory.points.count; ++i)
        openness[memory.points.index[i]] *= memory.free_part[i];
}

void Openness::find_free_parts(World world, ShadowMemory& shadow, OpennessMemory& memory) const {
    const uint32_t count = memory.points.count;
    if (count == 0) return;
    std::fill_n(memory.free, count, 0u);
    for (const OpenRay& ray : rays_.all()) trace(ray, world, shadow, memory);
    const auto samples = float(rays_.all().size());
    for (uint32_t i = 0; i < count; ++i) memory.free_part[i] = float(memory.free[i]) / samples;
}

void Openness::trace(const OpenRay& ray, World world, ShadowMemory& shadow,
                     OpennessMemory& memory) const {
    const uint32_t count = memory.points.count;
    memory.points.aim(ray, shadow.direction);
    std::fill_n(memory.length, count, range_ * ray.length);
    const trace::RayStream rays = {{shadow.origin[0], shadow.origin[1], shadow.origin[2]},
                                   {shadow.direction[0], shadow.direction[1], shadow.direction[2]},
                                   shadow.zeros,
                                   memory.length,
                                   count,
                                   trace::Coherence::incoherent};
    if (world == World::moving)
        shadows_.trace_moving(rays, shadow);
    else
        shadows_.trace_any(rays, shadow);
    memory.ray_count += count;
    for (uint32_t i = 0; i < count; ++i)
        memory.free[i] += shadow.occluded[i] == ShadowMemory::kFree;
}

} // namespace peregrine::shade
