#include "stage.h"

#include <string>

#include "camera.h"
#include "error.h"

namespace host {

namespace {

constexpr float light_tolerance = 0.03f; // of light in blocks

// For calls that take long: `user` is the std::function.
int32_t tell(void* user, float fraction) {
    (*static_cast<const std::function<void(float)>*>(user))(fraction);
    return 0;
}

void* to_user(const std::function<void(float)>& progress) {
    return const_cast<std::function<void(float)>*>(&progress);
}

} // namespace

Stage::Stage(const rt_api& api, uint32_t threads, rt_isa isa) : api_(api) {
    rt_scene_desc desc = rt_default_scene_desc();
    desc.worker_count = threads;
    desc.isa = isa;
    check(api_.create_scene(&desc, &scene_), "creating the scene");
}

Stage::~Stage() {
    api_.destroy_scene(scene_);
}

void Stage::check(rt_result result, const char* what) const {
    if (result == RT_OK) return;
    throw EngineError(std::string(what) + " failed with " + api_.get_result_name(result) + ": "
                      + api_.get_last_error());
}

rt_commit_report Stage::commit(rt_structure structure, rt_build_quality quality,
                               const std::function<void(float)>& progress, rt_light_proofs proofs) {
    rt_commit_desc desc = rt_default_commit_desc();
    desc.structure = structure;
    desc.quality = quality;
    desc.light_proofs = proofs;
    if (progress) {
        desc.progress = tell;
        desc.progress_user = to_user(progress);
    }
    rt_commit_report report = rt_default_commit_report();
    check(api_.commit_scene(scene_, &desc, &report), "building the scene");
    return report;
}

rt_bake_report Stage::bake(rt_bake_desc desc, const std::function<void(float)>& progress) {
    if (progress) {
        desc.progress = tell;
        desc.progress_user = to_user(progress);
    }
    rt_bake_report report = rt_default_bake_report();
    check(api_.bake_light(scene_, &desc, &report), "baking light");
    return report;
}

rt_frame_stats Stage::render(const Viewpoint& viewpoint, const Frame& frame, void* pixels) const {
    const rt_camera camera = camera_of(viewpoint);
    rt_frame_desc desc = rt_default_frame_desc();
    desc.format = frame.format;
    desc.pixels = pixels;
    desc.width = frame.width;
    desc.height = frame.height;
    desc.view = frame.view;
    desc.tone_mapping = frame.tone_mapping;
    desc.exposure = frame.exposure;
    desc.depth_range = frame.depth_range;
    desc.no_shadows = frame.no_shadows ? 1 : 0;
    desc.light_block = frame.light_block;
    desc.light_tolerance = light_tolerance;
    desc.edge_samples = frame.edge_samples;
    desc.occlusion_range = frame.occlusion_range;
    desc.occlusion_block = frame.occlusion_block;
    desc.bloom = frame.bloom;
    desc.airlight_shadows = frame.airlight_shadows;
    desc.airlight_block = 2;
    desc.measure_luminance = frame.measures_luminance ? 1 : 0;
    desc.particles = frame.particles;
    desc.snapshot = frame.snapshot;
    desc.render_width = frame.traced_width;
    desc.render_height = frame.traced_height;
    if (frame.governor)
        check(api_.govern_frame(frame.governor, &desc, frame.last), "choosing how fine a frame is");
    rt_frame_stats stats = rt_default_frame_stats();
    check(api_.render_frame(scene_, &camera, &desc, &stats), "rendering a frame");
    return stats;
}

rt_scene_stats Stage::stats() const {
    rt_scene_stats stats = rt_default_scene_stats();
    check(api_.get_scene_stats(scene_, &stats), "reading the scene's statistics");
    return stats;
}

} // namespace host
