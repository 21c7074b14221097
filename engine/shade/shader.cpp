#include "shade/shader.h"

#include "scene/alpha_test.h"
#include "trace/world/stream.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace peregrine::shade {
namespace {

// The largest distance along an axis from the point to one of the box.
float reach_between(const math::Vec3& point, const math::Box& box) {
    const math::Vec3 most = glm::max(glm::abs(box.lower - point), glm::abs(box.upper - point));
    return std::max({most.x, most.y, most.z});
}

} // namespace

void Scratch::initialize() {
    std::fill_n(just_above_zero, kPadded, 0x1p-12f);
    std::fill_n(just_below_one, kPadded, 1.0f - 0x1p-12f);
    std::fill_n(ones, kPadded, 1.0f);
    std::fill_n(infinities, kPadded, std::numeric_limits<float>::infinity());
}

Shader Shader::prepare(const scene::Snapshot& snapshot, uint32_t features, bool shadows,
                       std::span<const PreparedLight> lights, const math::Vec3d& origin) {
    float light_radius = 0;
    for (const PreparedLight& light : lights)
        if (light.from_light) light_radius = std::max(light_radius, light.radius);
    trace::Filter shadow_filter;
    shadow_filter.alpha = scene::alpha_test(snapshot);
    return {&snapshot,     &shade::kernels(snapshot.isa()),        lights,
            shadow_filter, {snapshot.world, origin, light_radius}, features,
            shadows};
}

void Shader::find_surfaces(const RayHits& hits, Scratch& scratch) const {
    kernels->find_surfaces(*snapshot, features, space, hits, scratch.surface);
}

void Shader::shade(const RayHits& hits, float* const radiance[3], Scratch& scratch) const {
    find_surfaces(hits, scratch);
    const bool specular = features & scene::kSpecular;
    const uint32_t floats = specular ? 6 * kPadded : 3 * kPadded;
    std::fill_n(&scratch.light.irradiance[0][0], floats, 0.0f);
    if (!scratch.surface.bounds.empty())
        for (const PreparedLight& light : lights)
            if (reaches(light, scratch.surface.bounds)) illuminate(light, hits, scratch);
    const bool emissive = features & scene::kEmissive;
    kernels->combine[specular][emissive](scratch.surface, scratch.light, hits,
                                         snapshot->environment, radiance);
}

// Whether a moving thing's box is in the way of that of all segments.
bool Shader::something_moves_before(const PreparedLight& light, const math::Box& points) const {
    if (!snapshot->world.nodes) return false;
    if (light.type == scene::LightType::directional) return true;
    math::Box segments = points;
    segments.extend(light.position);
    return trace::moving_may_meet(snapshot->world, segments);
}

void Shader::illuminate(const PreparedLight& light, const RayHits& hits, Scratch& scratch) const {
    using trace::visibility::State;
    if (light.from_light && light.radius > space.light_reach
        && reach_between(light.position, scratch.surface.bounds) > space.light_reach) [[unlikely]] {
        PreparedLight distant = light;
        distant.from_light = false;
        return illuminate(distant, hits, scratch);
    }
    const bool traces = shadows && light.casts_shadow;
    Recalled recalled;
    bool some_are_lit = false;
    if (traces && light.visibility) {
        const uint32_t occurs = kernels->recall(*light.visibility, scratch.surface,
                                                snapshot->world.first_moving, hits, scratch.states);
        if (occurs == 1u << uint32_t(State::hidden)) return;
        recalled.states = scratch.states;
        some_are_lit = occurs & 1u << uint32_t(State::lit);
        recalled.traces_lit = some_are_lit && something_moves_before(light, scratch.surface.bounds);
    }
    const bool specular = features & scene::kSpecular;
    const ShadowRays rays = {
        {scratch.shadow_origin[0], scratch.shadow_origin[1], scratch.shadow_origin[2]},
        {scratch.shadow_direction[0], scratch.shadow_direction[1], scratch.shadow_direction[2]},
        scratch.shadow_index};
    const WeighLights& by_falloff = kernels->weigh_light[uint32_t(light.type)];
    const uint32_t ray_count = by_falloff[uint32_t(light.falloff)][specular](
        scratch.surface, hits.count, light, recalled, scratch.weights, rays);
    if (ray_count == 0 && !some_are_lit) return;
    if (traces && ray_count > 0) {
        const uint32_t hidden = hide_occluded(light, ray_count, recalled.traces_lit, scratch);
        if (hidden == ray_count && !some_are_lit) return;
    }
    kernels->add_light[specular](scratch.weights, hits.count, light.color, scratch.light);
}

// Fixed and deforming meshes see rays relative to the world's origin, rounded to float.
trace::RayStream Shader::in_world(trace::RayStream rays, Scratch& scratch) const {
    if (!space.is_elsewhere) return rays;
    const uint32_t padded = (rays.count + 15) / 16 * 16;
    for (int k = 0; k < 3; ++k) {
        float* const moved = scratch.moved_origin[k];
        for (uint32_t i = 0; i < padded; ++i)
            moved[i] = float(double(rays.origin[k][i]) + space.origin[k]);
        rays.origin[k] = moved;
    }
    return rays;
}

// Takes the light away where something is in between; returns of how many rays. `some_are_lit`: as
// far as fixed triangles are concerned.
uint32_t Shader::hide_occluded(const PreparedLight& light, uint32_t ray_count, bool some_are_lit,
                               Scratch& scratch) const {
    scratch.shadow_ray_count += ray_count;
    trace::RayStream rays = {
        {scratch.shadow_origin[0], scratch.shadow_origin[1], scratch.shadow_origin[2]},
        {scratch.shadow_direction[0], scratch.shadow_direction[1], scratch.shadow_direction[2]},
        scratch.zeros,
        scratch.just_below_one,
        ray_count,
        trace::Coherence::coherent};
    if (light.type == scene::LightType::directional) rays.t_max = scratch.infinities;
    if (light.from_light) {
        for (int k = 0; k < 3; ++k)
            std::fill_n(scratch.shadow_origin[k], ray_count, light.position[k]);
        rays.t_min = scratch.just_above_zero;
        rays.t_max = scratch.ones;
        rays.coherence = trace::Coherence::common_origin;
    }
    const trace::Positions positions = {{rays.origin[0], rays.origin[1], rays.origin[2]},
                                        space.origin};
    if (some_are_lit) {
        ask_for_mixed(rays, scratch);
        trace::occluded_by_moving(snapshot->world, rays, positions, shadow_filter,
                                  scratch.occluded);
    } else {
        trace::occluded(snapshot->world, in_world(rays, scratch), positions, shadow_filter,
                        scratch.occluded);
    }
    uint32_t hidden = 0;
    for (uint32_t k = 0; k < ray_count; ++k) {
        // Without a branch: shadow edges are unpredictable.
        float& weight = scratch.weights.diffuse[scratch.shadow_index[k]];
        weight = std::bit_cast<float>(std::bit_cast<uint32_t>(weight)
                                      & (uint32_t(scratch.occluded[k]) - 1u));
        hidden += scratch.occluded[k];
    }
    return hidden;
}

// Whether fixed triangles occlude those rays of which that is not remembered; the others are lit.
void Shader::ask_for_mixed(const trace::RayStream& rays, Scratch& scratch) const {
    using trace::visibility::State;
    uint32_t count = 0;
    for (uint32_t k = 0; k < rays.count; ++k) {
        scratch.occluded[k] = 0;
        if (scratch.states[scratch.shadow_index[k]] == uint32_t(State::lit)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            scratch.fixed_origin[axis][count] = rays.origin[axis][k];
            scratch.fixed_direction[axis][count] = rays.direction[axis][k];
        }
        scratch.fixed_index[count++] = k;
    }
    if (count == 0) return;
    trace::RayStream asked = rays;
    for (int axis = 0; axis < 3; ++axis) {
        asked.origin[axis] = scratch.fixed_origin[axis];
        asked.direction[axis] = scratch.fixed_direction[axis];
    }
    asked.count = count;
    const trace::Part& fixed = snapshot->world.fixed;
    fixed.kernels->occluded_stream(fixed.target, asked, shadow_filter, scratch.fixed_occluded);
    for (uint32_t i = 0; i < count; ++i)
        scratch.occluded[scratch.fixed_index[i]] = scratch.fixed_occluded[i];
}

} // namespace peregrine::shade
