#include "shade/light/tints.h"

#include "scene/alpha_test.h"
#include "shade/light/passage.h"
#include "trace/world/stream.h"

#include <algorithm>

namespace peregrine::shade {
namespace {

// Whether the ray meets the box between its ends.
bool meets(const math::Box& box, const math::Ray& ray) {
    double begin = ray.t_min, end = ray.t_max;
    for (int k = 0; k < 3; ++k) {
        const double lower = double(box.lower[k]) - double(ray.origin[k]);
        const double upper = double(box.upper[k]) - double(ray.origin[k]);
        if (ray.direction[k] == 0) {
            if (lower > 0 || upper < 0) return false;
            continue;
        }
        const double a = lower / double(ray.direction[k]), b = upper / double(ray.direction[k]);
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return begin <= end;
}

} // namespace

Tints::Tints(const scene::Snapshot& snapshot, const SurfaceSpace& space) : snapshot_(&snapshot) {
    bounds_.lower = math::Vec3(math::Vec3d(snapshot.light_passing.lower) - space.origin);
    bounds_.upper = math::Vec3(math::Vec3d(snapshot.light_passing.upper) - space.origin);
    filter_.alpha = scene::alpha_test(snapshot);
}

// Of the rays that nothing opaque hides those that may pass something else.
uint32_t Tints::list(const trace::RayStream& rays, const Scratch& scratch,
                     TintMemory& memory) const {
    const ShadowMemory& shadow = scratch.shadow;
    uint32_t count = 0;
    for (uint32_t k = 0; k < rays.count; ++k) {
        if (shadow.occluded[k] == ShadowMemory::kOccluded
            || scratch.weights.diffuse[shadow.index[k]] == 0 || !meets(bounds_, ray_at(rays, k)))
            continue;
        for (int axis = 0; axis < 3; ++axis) {
            memory.origin[axis][count] = rays.origin[axis][k];
            memory.direction[axis][count] = rays.direction[axis][k];
        }
        memory.ray[count++] = k;
    }
    return count;
}

void Tints::take(const Shadows& shadows, const PreparedLight& light, uint32_t ray_count,
                 Scratch& scratch) const {
    TintMemory& memory = *scratch.tints;
    ShadowMemory& shadow = scratch.shadow;
    trace::RayStream rays = shadows.list(light, ray_count, shadow);
    memory.count = 0;
    rays.count = list(rays, scratch, memory);
    if (rays.count == 0) return;
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis] = memory.origin[axis];
        rays.direction[axis] = memory.direction[axis];
    }
    shadow.ray_count += rays.count;
    const trace::Positions positions = shadows.positions_of(rays);
    rays = shadows.in_world(rays, shadow);
    trace::occluded(snapshot_->world, rays, positions, filter_, memory.meets);
    for (uint32_t i = 0; i < rays.count; ++i) {
        if (!memory.meets[i]) continue;
        const math::Vec3 tint = passage(*snapshot_, filter_, ray_at(rays, i), positions[i]);
        if (tint == math::Vec3(1)) continue;
        const uint32_t ray = memory.ray[i], point = shadow.index[ray];
        float& weight = scratch.weights.diffuse[point];
        memory.point[memory.count] = point;
        memory.weight[memory.count] = weight;
        memory.tint[memory.count++] = tint;
        weight = 0;
        shadow.occluded[ray] =
            tint == math::Vec3(0) ? ShadowMemory::kOccluded : ShadowMemory::kPenumbra;
    }
}

void Tints::give_back(const PreparedLight& light, Program program, Scratch& scratch) const {
    const TintMemory& memory = *scratch.tints;
    for (uint32_t i = 0; i < memory.count; ++i) {
        const uint32_t point = memory.point[i];
        scratch.weights.diffuse[point] = memory.weight[i]; // whoever marks points looks at it
        for (int k = 0; k < 3; ++k) {
            const float part = light.color[k] * memory.weight[i] * memory.tint[i][k];
            scratch.light.irradiance[k][point] += part;
            if (program != Program::matt)
                scratch.light.highlight[k][point] += part * scratch.weights.lobe[point];
        }
    }
}

} // namespace peregrine::shade
