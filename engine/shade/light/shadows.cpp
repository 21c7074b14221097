#include "shade/light/shadows.h"

#include "scene/alpha_test.h"
#include "trace/world/stream.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace peregrine::shade {

void ShadowMemory::initialize() {
    std::fill_n(just_above_zero, kPadded, 0x1p-12f);
    std::fill_n(just_below_one, kPadded, 1.0f - 0x1p-12f);
    std::fill_n(ones, kPadded, 1.0f);
    std::fill_n(infinities, kPadded, std::numeric_limits<float>::infinity());
}

Shadows::Shadows(const scene::Snapshot& snapshot, const SurfaceSpace& space)
    : snapshot_(&snapshot), space_(space) {
    filter_.alpha = scene::light_test(snapshot);
    filter_.asks = trace::Asks::light;
}

void Shadows::see_opaque_alone() {
    filter_.alpha = scene::opacity_test(*snapshot_);
    filter_.asks = trace::Asks::opacity;
}

// Whether a moving thing's box is in the way of that of all segments.
bool Shadows::something_moves_before(const PreparedLight& light, const math::Box& points) const {
    if (!snapshot_->world.nodes) return false;
    if (light.type == scene::LightType::directional) return true;
    math::Box segments = points;
    segments.extend(light.position);
    return trace::moving_may_meet(snapshot_->world, segments);
}

bool Shadows::something_moves_near(const math::Box& points, float distance) const {
    if (!snapshot_->world.nodes || points.empty()) return false;
    const math::Vec3 reach(distance);
    return trace::moving_may_meet(snapshot_->world, {points.lower - reach, points.upper + reach});
}

trace::RayStream Shadows::list(const PreparedLight& light, uint32_t ray_count,
                               ShadowMemory& memory) const {
    trace::RayStream rays = {{memory.origin[0], memory.origin[1], memory.origin[2]},
                             {memory.direction[0], memory.direction[1], memory.direction[2]},
                             memory.zeros,
                             memory.just_below_one,
                             ray_count,
                             trace::Coherence::coherent};
    if (light.type == scene::LightType::directional) rays.t_max = memory.infinities;
    if (light.from_light) {
        for (int k = 0; k < 3; ++k) std::fill_n(memory.origin[k], ray_count, light.position[k]);
        rays.t_min = memory.just_above_zero;
        rays.t_max = memory.ones;
        rays.coherence = trace::Coherence::common_origin;
    }
    return rays;
}

trace::Positions Shadows::positions_of(const trace::RayStream& rays) const {
    return {{rays.origin[0], rays.origin[1], rays.origin[2]}, space_.origin};
}

// Relative to the world's origin, rounded to float.
trace::RayStream Shadows::in_world(trace::RayStream rays, ShadowMemory& memory) const {
    if (!space_.is_elsewhere) return rays;
    const uint32_t padded = (rays.count + 15) / 16 * 16;
    for (int k = 0; k < 3; ++k) {
        float* const moved = memory.moved_origin[k];
        for (uint32_t i = 0; i < padded; ++i)
            moved[i] = float(double(rays.origin[k][i]) + space_.origin[k]);
        rays.origin[k] = moved;
    }
    return rays;
}

void Shadows::trace(const PreparedLight& light, uint32_t ray_count, ShadowMemory& memory) const {
    memory.ray_count += ray_count;
    trace_any(list(light, ray_count, memory), memory);
}

void Shadows::trace_any(const trace::RayStream& rays, ShadowMemory& memory) const {
    trace::occluded(snapshot_->world, in_world(rays, memory), positions_of(rays), filter_,
                    memory.occluded);
}

void Shadows::trace_moving(const trace::RayStream& rays, ShadowMemory& memory) const {
    std::fill_n(memory.occluded, rays.count, ShadowMemory::kFree);
    trace::occluded_by_moving(snapshot_->world, in_world(rays, memory), positions_of(rays), filter_,
                              memory.occluded);
}

uint32_t Shadows::hide_occluded(const PreparedLight& light, uint32_t ray_count, bool some_are_lit,
                                ShadowMemory& memory, LightWeights& weights) const {
    if (some_are_lit) {
        const trace::RayStream rays = list(light, ray_count, memory);
        memory.ray_count += ray_count;
        ask_for_mixed(rays, memory);
        trace::occluded_by_moving(snapshot_->world, rays, positions_of(rays), filter_,
                                  memory.occluded);
    } else {
        trace(light, ray_count, memory);
    }
    uint32_t hidden = 0;
    for (uint32_t k = 0; k < ray_count; ++k) hidden += memory.occluded[k];
    if (hidden == 0) return 0;
    for (uint32_t k = 0; k < ray_count; ++k) {
        // Without a branch: shadow edges are unpredictable.
        float& weight = weights.diffuse[memory.index[k]];
        weight = std::bit_cast<float>(std::bit_cast<uint32_t>(weight)
                                      & (uint32_t(memory.occluded[k]) - 1u));
    }
    return hidden;
}

// Whether fixed triangles occlude those rays of which that is not remembered; the others are lit.
void Shadows::ask_for_mixed(const trace::RayStream& rays, ShadowMemory& memory) const {
    using trace::visibility::State;
    uint32_t count = 0;
    for (uint32_t k = 0; k < rays.count; ++k) {
        memory.occluded[k] = 0;
        if (memory.states[memory.index[k]] == uint32_t(State::lit)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            memory.fixed_origin[axis][count] = rays.origin[axis][k];
            memory.fixed_direction[axis][count] = rays.direction[axis][k];
        }
        memory.fixed_index[count++] = k;
    }
    if (count == 0) return;
    trace::RayStream asked = rays;
    for (int axis = 0; axis < 3; ++axis) {
        asked.origin[axis] = memory.fixed_origin[axis];
        asked.direction[axis] = memory.fixed_direction[axis];
    }
    asked.count = count;
    const trace::Part& fixed = snapshot_->world.fixed;
    fixed.kernels->occluded_stream(fixed.target, asked, filter_, memory.fixed_occluded);
    for (uint32_t i = 0; i < count; ++i)
        memory.occluded[memory.fixed_index[i]] = memory.fixed_occluded[i];
}

} // namespace peregrine::shade
