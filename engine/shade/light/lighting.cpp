#include "shade/light/lighting.h"

#include "shade/light/penumbra.h"

#include <algorithm>

namespace peregrine::shade {
namespace {

// The largest distance along an axis from the point to one of the box.
float reach_between(const math::Vec3& point, const math::Box& box) {
    const math::Vec3 most = glm::max(glm::abs(box.lower - point), glm::abs(box.upper - point));
    return std::max({most.x, most.y, most.z});
}

// Whether what was proved of lights is true of this frame's surfaces (trace/visibility/shaft.h).
bool proofs_hold(const SurfaceSpace& space) {
    return !space.is_elsewhere && space.fixed_reach <= 2 * space.fixed_size;
}

constexpr uint32_t bit(PointState state) {
    return 1u << uint32_t(state);
}

// Puts what neighbours know over what is remembered; returns which states occur then.
uint32_t overlay(const BatchMarks& marks, uint32_t slot, uint32_t count, uint32_t* states) {
    if (slot < LightMarks::kLights) {
        const uint32_t shift = slot % 32;
        const uint32_t* const lit = marks.known_lit[slot / 32];
        const uint32_t* const dark = marks.known_dark[slot / 32];
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t seen = 0u - (lit[i] >> shift & 1), hidden = 0u - (dark[i] >> shift & 1);
            states[i] = ((states[i] & ~seen) | (uint32_t(PointState::seen) & seen)) & ~hidden;
        }
    }
    uint32_t occurs[4] = {};
    for (uint32_t i = 0; i < count; ++i) occurs[states[i]] = 1;
    return occurs[0] | occurs[1] << 1 | occurs[2] << 2 | occurs[3] << 3;
}
static_assert(uint32_t(PointState::hidden) == 0);

} // namespace

Lighting::Lighting(const scene::Snapshot& snapshot, std::span<const PreparedLight> lights,
                   const SurfaceSpace& space, Program program, bool shadows, float unseen)
    : snapshot_(&snapshot), kernels_(&kernels(snapshot.isa())), lights_(lights), space_(space),
      choice_(*snapshot.lights, lights, space.origin, unseen), shadows_(snapshot, space),
      program_(program), traces_shadows_(shadows), recalls_(proofs_hold(space)) {}

void Lighting::gather(const RayHits& hits, Scratch& scratch, BatchMarks* marks) const {
    scratch.light.clear(program_);
    const math::Box& bounds = scratch.surface.bounds;
    if (bounds.empty()) return;
    for (const uint32_t i : choice_.reaching(bounds, scratch.lists))
        illuminate({lights_[i], marks ? marks->slots->of(i) : 0, hits, scratch, marks});
}

// What need not be traced of a light that casts shadows.
Lighting::Known Lighting::find_known(const Task& task) const {
    Known known;
    const PreparedLight& light = task.light;
    const bool has_marks = task.marks && task.marks->any_known;
    const trace::visibility::PointVisibility* const visibility =
        recalls_ ? light.visibility : nullptr;
    if (!visibility && !has_marks) return known;
    uint32_t* const states = task.scratch.shadow.states;
    uint32_t occurs = 0;
    if (visibility)
        occurs = kernels_->recall(*visibility, task.scratch.surface, snapshot_->world.first_moving,
                                  task.hits, states);
    else
        std::fill_n(states, task.hits.count, uint32_t(PointState::mixed));
    if (has_marks) occurs = overlay(*task.marks, task.slot, task.hits.count, states);
    known.recalled.states = states;
    known.all_are_hidden = occurs == bit(PointState::hidden);
    known.some_are_lit = occurs & (bit(PointState::lit) | bit(PointState::seen));
    known.recalled.traces_lit =
        (occurs & bit(PointState::lit))
        && shadows_.something_moves_before(light, task.scratch.surface.bounds);
    return known;
}

// Notes who sees the light, once it was weighed and its rays were traced.
void Lighting::mark(const Task& task, const Known& known, uint32_t ray_count) const {
    const ShadowMemory& shadow = task.scratch.shadow;
    BatchMarks& marks = *task.marks;
    for (uint32_t k = 0; k < ray_count; ++k) {
        uint8_t& traced = marks.traced[shadow.index[k]];
        traced = uint8_t(traced + (traced < 255));
    }
    if (!marks.finds) return;
    for (uint32_t i = 0; known.recalled.states && i < task.hits.count; ++i) {
        if (shadow.states[i] == uint32_t(PointState::hidden))
            marks.found[i].miss(task.slot);
        else if (shadow.states[i] != uint32_t(PointState::mixed)
                 && task.scratch.weights.diffuse[i] > 0)
            marks.found[i].see(task.slot);
    }
    for (uint32_t k = 0; k < ray_count; ++k) {
        LightMarks& point = marks.found[shadow.index[k]];
        if (shadow.occluded[k] != ShadowMemory::kFree) point.miss(task.slot);
        if (shadow.occluded[k] != ShadowMemory::kOccluded
            && task.scratch.weights.diffuse[shadow.index[k]] > 0)
            point.see(task.slot);
    }
}

void Lighting::illuminate(const Task& task) const {
    const PreparedLight& light = task.light;
    Scratch& scratch = task.scratch;
    if (light.from_light && light.radius + light.source_radius > space_.light_reach
        && reach_between(light.position, scratch.surface.bounds) + light.source_radius
               > space_.light_reach) [[unlikely]] {
        PreparedLight distant = light;
        distant.from_light = false;
        return illuminate({distant, task.slot, task.hits, scratch, task.marks});
    }
    const bool traces = traces_shadows_ && light.casts_shadow;
    const Known known = traces ? find_known(task) : Known();
    const bool marks = traces && task.marks;
    if (known.all_are_hidden) {
        if (marks) mark(task, known, 0);
        return;
    }
    ShadowMemory& shadow = scratch.shadow;
    const ShadowRays rays = {{shadow.origin[0], shadow.origin[1], shadow.origin[2]},
                             {shadow.direction[0], shadow.direction[1], shadow.direction[2]},
                             shadow.index};
    const WeighLights& by_falloff = kernels_->weigh_light[uint32_t(light.type)];
    const uint32_t ray_count = by_falloff[uint32_t(light.falloff)][uint32_t(program_)](
        scratch.surface, task.hits.count, light, known.recalled, scratch.weights, rays);
    bool any_is_lit = ray_count > 0 || known.some_are_lit;
    if (traces && ray_count > 0) {
        const uint32_t hidden =
            light.source_radius > 0
                ? hide_penumbra(shadows_, light, ray_count, shadow, scratch.weights)
                : shadows_.hide_occluded(light, ray_count, known.recalled.traces_lit, shadow,
                                         scratch.weights);
        any_is_lit = hidden < ray_count || known.some_are_lit;
    }
    const bool tints = tints_ && traces && ray_count > 0 && any_is_lit;
    if (tints) {
        if (light.source_radius > 0) list_centers_again(ray_count, shadow);
        tints_->take(shadows_, light, ray_count, scratch);
    }
    if (any_is_lit)
        kernels_->add_light[uint32_t(program_)](scratch.weights, task.hits.count, light.color,
                                                scratch.light);
    if (tints) tints_->give_back(light, program_, scratch);
    if (marks) mark(task, known, ray_count);
}

} // namespace peregrine::shade
