// Light that is baked, through the header.
#include "support.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

constexpr float kRange = 1.5f;

rt_bake_desc quick() {
    rt_bake_desc desc = rt_default_bake_desc();
    desc.samples = 16;
    desc.spacing = 2;
    desc.occlusion_range = kRange;
    return desc;
}

Bytes picture(rt_scene scene, uint32_t baked_light, rt_frame_stats* stats = nullptr) {
    rt_frame_desc frame = rt_default_frame_desc();
    Bytes pixels(64 * 48 * 4);
    frame.pixels = pixels.data();
    frame.width = 64;
    frame.height = 48;
    frame.occlusion_range = kRange;
    frame.occlusion_block = 1;
    frame.baked_light = baked_light;
    const rt_camera camera = world_camera();
    EXPECT_OK(rt_render_frame(scene, &camera, &frame, stats));
    return pixels;
}

uint64_t occlusion_rays(rt_scene scene, uint32_t baked_light) {
    rt_frame_stats stats = rt_default_frame_stats();
    picture(scene, baked_light, &stats);
    return stats.rays_occlusion;
}

int32_t cancel_after(void* user, float fraction) {
    EXPECT_TRUE(fraction >= 0 && fraction <= 1);
    return --*static_cast<int*>(user) < 0;
}

TEST(Bake, IsShownByTheNextCommit) {
    WorldGuard world;
    const rt_scene scene = world->scene;
    const Bytes before = picture(scene, 1);
    const rt_bake_desc desc = quick();
    rt_bake_report report = rt_default_bake_report();
    ASSERT_OK(rt_bake_light(scene, &desc, &report));
    EXPECT_GT(report.point_count, 0u);
    EXPECT_GE(report.sampled_count, 3u);
    EXPECT_GT(report.rays, report.sampled_count);
    EXPECT_GE(report.bytes, report.point_count * 4);
    EXPECT_GT(report.bake_ms, 0);
    EXPECT_EQ(occlusion_rays(scene, 1), occlusion_rays(scene, 0)) << "not yet";
    ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
    EXPECT_EQ(picture(scene, 0), before) << "a frame may do without";
    EXPECT_LT(occlusion_rays(scene, 1), occlusion_rays(scene, 0));

    // Until the static meshes change.
    ASSERT_OK(move_lift(*world, 2));
    ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
    EXPECT_LT(occlusion_rays(scene, 1), occlusion_rays(scene, 0));
    ASSERT_OK(rt_remove_mesh(scene, world->ground));
    ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
    EXPECT_EQ(picture(scene, 1), picture(scene, 0));
    EXPECT_OK(rt_bake_light(scene, &desc, nullptr)); // there is nothing
    ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
    EXPECT_EQ(picture(scene, 1), picture(scene, 0));
}

TEST(Bake, KeepsWhatWasThereIfItFails) {
    WorldGuard world;
    const rt_scene scene = world->scene;
    rt_bake_desc desc = quick();
    ASSERT_OK(rt_bake_light(scene, &desc, nullptr));
    ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
    const Bytes baked = picture(scene, 1);
    desc.samples = 8;
    desc.progress = cancel_after;
    for (int calls = 0; calls < 2; ++calls) { // of openness, of light
        int left = calls;
        desc.progress_user = &left;
        EXPECT_EQ(rt_bake_light(scene, &desc, nullptr), RT_ERROR_CANCELLED) << calls;
    }
    desc.progress = nullptr;
    desc.most_bytes = 1;
    EXPECT_EQ(rt_bake_light(scene, &desc, nullptr), RT_ERROR_LIMIT);
    EXPECT_NE(std::string(rt_get_last_error()).find("at least"), std::string::npos);
    ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
    EXPECT_EQ(picture(scene, 1), baked);
}

TEST(Bake, RefusesWhatMakesNoSense) {
    WorldGuard world;
    const auto refuse = [&](const auto& spoil, rt_result expected, const char* words) {
        rt_bake_desc desc = quick();
        spoil(desc);
        EXPECT_EQ(rt_bake_light(world->scene, &desc, nullptr), expected);
        EXPECT_NE(std::string(rt_get_last_error()).find(words), std::string::npos)
            << rt_get_last_error();
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const float value : {-1.0f, kNan, -kInfinity}) {
        refuse([&](rt_bake_desc& d) { d.occlusion_range = value; }, RT_ERROR_INVALID_ARGUMENT,
               "rt_bake_desc.occlusion_range");
        refuse([&](rt_bake_desc& d) { d.spacing = value; }, RT_ERROR_INVALID_ARGUMENT,
               "rt_bake_desc.spacing");
        refuse([&](rt_bake_desc& d) { d.tolerance = value; }, RT_ERROR_INVALID_ARGUMENT,
               "rt_bake_desc.tolerance");
    }
    refuse([](rt_bake_desc& d) { d.samples = 257; }, RT_ERROR_LIMIT, "rt_bake_desc.samples");
    refuse([](rt_bake_desc& d) { d.bounces = 9; }, RT_ERROR_LIMIT, "rt_bake_desc.bounces is 9");
    rt_scene fresh;
    const rt_scene_desc scene_desc = rt_default_scene_desc();
    ASSERT_OK(rt_create_scene(&scene_desc, &fresh));
    EXPECT_EQ(rt_bake_light(fresh, nullptr, nullptr), RT_ERROR_NOT_COMMITTED);
    EXPECT_OK(rt_destroy_scene(fresh));
}

TEST(Bake, GoesToExtremes) {
    WorldGuard world;
    for (const float spacing : {1e-30f, 1e30f})
        for (const float range : {1e-30f, 1e30f, std::numeric_limits<float>::infinity()}) {
            rt_bake_desc desc = quick();
            desc.samples = 1;
            desc.spacing = spacing;
            desc.occlusion_range = range;
            ASSERT_OK(rt_bake_light(world->scene, &desc, nullptr));
            ASSERT_OK(rt_commit_scene(world->scene, nullptr, nullptr));
            picture(world->scene, 1);
        }
}

// Baking pins a snapshot, and takes as long as it takes.
TEST(Bake, RunsBesideCommitsAndFrames) {
    WorldGuard world;
    const rt_scene scene = world->scene;
    const rt_bake_desc desc = quick();
    ASSERT_OK(rt_bake_light(scene, &desc, nullptr));
    ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
    const Bytes expected = picture(scene, 1);
    std::atomic<bool> stop{false};
    std::thread baker([&] {
        for (int i = 0; i < 5; ++i) EXPECT_OK(rt_bake_light(scene, &desc, nullptr));
        stop = true;
    });
    while (!stop) {
        ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
        ASSERT_EQ(picture(scene, 1), expected);
    }
    baker.join();
}

} // namespace
} // namespace peregrine::test
