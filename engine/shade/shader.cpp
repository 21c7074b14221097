#include "shade/shader.h"

#include <algorithm>

namespace peregrine::shade {
namespace {

// The largest distance along an axis from the point to one of the box.
float reach_between(const math::Vec3& point, const math::Box& box) {
    const math::Vec3 most = glm::max(glm::abs(box.lower - point), glm::abs(box.upper - point));
    return std::max({most.x, most.y, most.z});
}

} // namespace

Shader::Shader(const scene::Snapshot& snapshot, uint32_t features, bool shadows,
               std::span<const PreparedLight> lights, const math::Vec3d& origin, float unseen)
    : snapshot_(&snapshot), kernels_(&kernels(snapshot.isa())), lights_(lights),
      choice_(*snapshot.lights, lights, origin, unseen),
      space_(snapshot.world, origin, lights.empty() ? 0 : snapshot.lights->largest_radius),
      shadows_(snapshot, space_), features_(features), program_(program_for(features)),
      traces_shadows_(shadows) {}

void Shader::find_surfaces(const RayHits& hits, Scratch& scratch) const {
    const FindSurfaces find = kernels_->find_surfaces[uint32_t(SurfacePart::all)];
    find(*snapshot_, features_, space_, hits, scratch.surface);
}

void Shader::shade(const RayHits& hits, float* const radiance[3], Scratch& scratch) const {
    find_surfaces(hits, scratch);
    scratch.light.clear(program_);
    if (!scratch.surface.bounds.empty())
        for (const uint32_t i : choice_.reaching(scratch.surface.bounds, scratch.lists))
            illuminate(lights_[i], hits, scratch);
    const bool emissive = features_ & scene::kEmissive;
    kernels_->find_radiance[emissive][uint32_t(program_)](scratch.surface, scratch.light, hits,
                                                          snapshot_->environment, radiance);
}

void Shader::illuminate(const PreparedLight& light, const RayHits& hits, Scratch& scratch) const {
    using trace::visibility::State;
    if (light.from_light && light.radius > space_.light_reach
        && reach_between(light.position, scratch.surface.bounds) > space_.light_reach)
        [[unlikely]] {
        PreparedLight distant = light;
        distant.from_light = false;
        return illuminate(distant, hits, scratch);
    }
    const bool traces = traces_shadows_ && light.casts_shadow;
    ShadowMemory& shadow = scratch.shadow;
    Recalled recalled;
    bool some_are_lit = false;
    if (traces && light.visibility && proofs_hold()) {
        const uint32_t occurs = kernels_->recall(
            *light.visibility, scratch.surface, snapshot_->world.first_moving, hits, shadow.states);
        if (occurs == 1u << uint32_t(State::hidden)) return;
        recalled.states = shadow.states;
        some_are_lit = occurs & 1u << uint32_t(State::lit);
        recalled.traces_lit =
            some_are_lit && shadows_.something_moves_before(light, scratch.surface.bounds);
    }
    const ShadowRays rays = {{shadow.origin[0], shadow.origin[1], shadow.origin[2]},
                             {shadow.direction[0], shadow.direction[1], shadow.direction[2]},
                             shadow.index};
    const WeighLights& by_falloff = kernels_->weigh_light[uint32_t(light.type)];
    const uint32_t ray_count = by_falloff[uint32_t(light.falloff)][uint32_t(program_)](
        scratch.surface, hits.count, light, recalled, scratch.weights, rays);
    if (ray_count == 0 && !some_are_lit) return;
    if (traces && ray_count > 0) {
        const uint32_t hidden =
            shadows_.hide_occluded(light, ray_count, recalled.traces_lit, shadow, scratch.weights);
        if (hidden == ray_count && !some_are_lit) return;
    }
    kernels_->add_light[uint32_t(program_)](scratch.weights, hits.count, light.color,
                                            scratch.light);
}

} // namespace peregrine::shade
