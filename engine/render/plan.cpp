#include "render/plan.h"

#include "render/bounces.h"
#include "render/film.h"
#include "render/occlusion.h"
#include "render/particles.h"
#include "render/planes.h"
#include "render/post/bloom.h"
#include "render/post/encode.h"
#include "render/post/luminance.h"
#include "render/post/tones.h"
#include "render/primary_rays.h"
#include "render/shading.h"
#include "render/unseen_light.h"
#include "render/views.h"
#include "scene/alpha_test.h"

#include <algorithm>
#include <cmath>

namespace peregrine::render {
namespace {

// The features that a frame looks at.
uint32_t features_seen(const scene::Snapshot& snapshot, const Frame& frame) {
    if (!frame.pixels) return 0;
    const bool has_light = frame.view == View::shaded || frame.view == View::light;
    return has_light ? snapshot.features : snapshot.features & scene::kNormalMaps;
}

trace::Filter primary_filter(const scene::Snapshot& snapshot) {
    trace::Filter filter;
    filter.cull_single_sided = (snapshot.features & scene::kSingleSidedMaterials) != 0;
    filter.alpha = scene::alpha_test(snapshot);
    return filter;
}

constexpr double kFar = 1024;      // metres
constexpr float kUnseen = 0.0007f; // radiance: half a step of the filmic curve in the dark

// What surfaces and lights are relative to while they are shaded: the world's origin, or the eye if
// it sees meshes that keep their precision far away from there.
math::Vec3d shading_origin(const scene::Snapshot& snapshot, const math::Vec3d& eye) {
    const bool is_far = std::max({std::fabs(eye.x), std::fabs(eye.y), std::fabs(eye.z)}) > kFar;
    return is_far && !snapshot.placements.empty() ? eye : math::Vec3d(0);
}

// The snapshot's lights relative to the origin; in `room` if that is not the snapshot's.
std::span<const shade::PreparedLight> lights_from(const scene::LightSet& set,
                                                  const math::Vec3d& origin,
                                                  base::Vector<shade::PreparedLight>& room) {
    if (origin == math::Vec3d(0)) return set.prepared;
    room = set.prepared;
    for (size_t i = 0; i < room.size(); ++i)
        room[i].position = math::Vec3(set.lights[i].position - origin);
    return room;
}

// Where no light comes from all around, nothing can be in its way.
bool sees_occlusion(const scene::Snapshot& snapshot, const Frame& frame) {
    if (!frame.pixels || frame.occlusion.range <= 0) return false;
    return frame.view == View::occlusion
           || (frame.view == View::shaded && snapshot.environment.ambient != math::Vec3(0));
}

shade::Shader make_shader(const scene::Snapshot& snapshot, const Camera& camera, const Frame& frame,
                          base::Vector<shade::PreparedLight>& room) {
    const math::Vec3d origin = shading_origin(snapshot, camera.position);
    std::span<const shade::PreparedLight> lights;
    if (frame.pixels) lights = lights_from(*snapshot.lights, origin, room);
    shade::Shader shader(snapshot, features_seen(snapshot, frame), frame.shadows, lights, origin,
                         unseen_light(snapshot, frame));
    if (sees_occlusion(snapshot, frame))
        shader.occlude_ambient_light(frame.occlusion.range, frame.occlusion.samples);
    if (frame.baked_light && snapshot.light_map) {
        const scene::LightMap& map = *snapshot.light_map;
        const bool is_same = map.openness.any() && map.range == frame.occlusion.range;
        if (shader.finds_openness() && is_same && !shader.space().is_elsewhere)
            shader.recall_openness_from(map.openness);
        if (frame.is_shaded() && map.bounced.any()) shader.add_bounced_light_from(map.bounced);
    }
    if (frame.tinted_shadows && !lights.empty()
        && (snapshot.features & scene::kLightPassingFeatures))
        shader.tint_light();
    return shader;
}

shade::AirShadows air_shadows(const Frame& frame) {
    return {frame.shadows ? frame.airlight_pieces : 0, frame.airlight_block * frame.airlight_block};
}

shade::PathLimits path_limits(const scene::Snapshot& snapshot, const Frame& frame) {
    if (!frame.is_shaded() || !(snapshot.features & scene::kPathFeatures)) return {};
    return {frame.bounces.max_depth, frame.bounces.least_importance / frame.exposure};
}

// What the eye of a frame with paths is in.
shade::Media eye_media(const Plan& plan, const Camera& camera) {
    if (!(plan.snapshot.features & scene::kTransmission)
        || path_limits(plan.snapshot, plan.frame).max_depth == 0)
        return {};
    return media_at(plan.snapshot, camera.position, camera.forward, plan.filter);
}

Stage stage_of(const Frame& frame, bool has_paths) {
    const bool in_blocks = frame.finds_blocks();
    switch (frame.view) {
    case View::normals:
        return show_normals;
    case View::depth:
        return show_depth;
    case View::steps:
        return show_steps;
    case View::light:
        return show_light;
    case View::occlusion:
        return show_openness;
    default:
        if (has_paths) return in_blocks ? shade_blocks_and_follow : shade_tile_and_follow;
        return in_blocks ? shade_blocks : shade_tile;
    }
}

} // namespace

Plan::Plan(const scene::Snapshot& snapshot_, const Camera& camera, const Frame& frame_,
           base::Vector<shade::PreparedLight>& moved_lights, Film* film_, const post::Bloom* bloom_,
           const Particles* particles_)
    : snapshot(snapshot_), frame(frame_), extent(frame_.traced()), film(film_), bloom(bloom_),
      particles(particles_),
      pinhole(camera, frame_.width, frame_.height, extent.width, extent.height),
      eye(camera.position), filter(primary_filter(snapshot_)),
      shader(make_shader(snapshot_, camera, frame_, moved_lights)),
      block_light(shader, snapshot_.environment, frame_.approximations.light_tolerance,
                  glm::length(pinhole.right), kUnseen / frame_.exposure),
      block_openness(shader,
                     {frame_.occlusion.tolerance, frame_.occlusion.normal_tolerance,
                      frame_.occlusion.plane_tolerance},
                     glm::length(pinhole.right)),
      fog(frame_.is_shaded() ? snapshot_.fog : scene::Fog(), shader.kernels(), shader.space(), eye),
      airlight(snapshot_, fog, shader.lights(), shader.space(), air_shadows(frame_)),
      paths(snapshot_, shader, fog, airlight, filter, path_limits(snapshot_, frame_),
            eye_media(*this, camera)) {
    if (frame.wants_planes()) stages_.add(fetch_planes);
    stages_.add(trace_primary_rays);
    if (frame.wants_planes()) stages_.add(write_planes);
    if (!frame.pixels) return;
    if (shader.finds_openness()) stages_.add(find_openness);
    stages_.add(stage_of(frame, paths.any()));
    if (frame.is_shaded() && shader.has_sky() && !paths.any()) stages_.add(paint_sky);
    if (fog.any() && !paths.any()) stages_.add(hide_in_fog);
    if (particles) stages_.add(add_particles);
    if (frame.counts_luminance()) stages_.add(post::count_luminance);
    if (frame.looks_for_edges()) stages_.add(keep_edges);
    if (bloom) {
        stages_.add(keep_radiance);
        later_stages_.add(take_spread_light);
    }
    finish(bloom ? later_stages_ : stages_);
}

void Plan::finish(Stages& stages) const {
    if (frame.looks_for_edges() || frame.is_enlarged()) stages.add(keep_shown);
    if (frame.is_enlarged()) return;
    stages.add(post::tones_of(frame));
    stages.add(post::encoder_of(frame));
}

} // namespace peregrine::render
