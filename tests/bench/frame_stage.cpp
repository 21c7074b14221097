#include "frame_stage.h"

#include "timing.h"

#include "animation/player.h"
#include "camera.h"
#include "cameras.h"
#include "upload.h"

namespace peregrine::bench {
namespace {

constexpr float kAmbient = 0.1f;

} // namespace

Seconds Seconds::now() {
    return {process_seconds(), wall_seconds()};
}

FrameStage::FrameStage(const rt_api& api, const host::Level& level, uint32_t threads,
                       rt_light_proofs proofs, rt_isa isa)
    : stage_(api, threads, isa), report_(rt_default_commit_report()) {
    host::Player player(stage_, level, host::upload_level(stage_, level, kAmbient));
    player.describe(0);
    rt_commit_desc commit = rt_default_commit_desc();
    commit.light_proofs = proofs;
    stage_.check(api.commit_scene(stage_.scene(), &commit, &report_), "building the scene");
}

RenderedFrame FrameStage::render(const rt_frame_desc& desc, const host::Viewpoint& view) const {
    const rt_camera camera = host::camera_of(view);
    RenderedFrame frame{rt_default_frame_stats(), {}};
    const Seconds start = Seconds::now();
    const rt_result result =
        stage_.api().render_frame(stage_.scene(), &camera, &desc, &frame.stats);
    frame.seconds = Seconds::now() - start;
    stage_.check(result, "rendering a frame");
    return frame;
}

std::vector<host::Viewpoint> standing_cameras(const host::Level& level) {
    host::Pose pose(level.rig);
    pose.set(0);
    std::vector<host::Viewpoint> cameras = host::usable_cameras(level);
    for (host::Viewpoint& camera : cameras) {
        if (camera.node == host::no_index) continue;
        const auto place = host::look_along(pose.world(camera.node));
        if (!place) continue;
        camera.position = place->position;
        camera.forward = place->forward;
        camera.up = place->up;
    }
    return cameras;
}

} // namespace peregrine::bench
