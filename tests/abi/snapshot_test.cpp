// Snapshots that the host holds, and worlds that lie far away.
#include "ask.h"
#include "bad_input.h"

#include <array>
#include <atomic>
#include <thread>

namespace peregrine::test {
namespace {

class HeldSnapshot : public BadInput {};

rt_query_options options_of(rt_snapshot snapshot) {
    rt_query_options options = rt_default_query_options();
    options.snapshot = snapshot;
    return options;
}

// What a ray from above hits: the lift, at `height`, or the ground below it.
rt_hit look_down(rt_scene scene, const rt_query_options* options) {
    const rt_ray ray = {{0.5f, 50, 0.25f}, 0, {0, -1, 0}, kInfinity};
    return trace_one(scene, ray, options);
}

Bytes render_held(rt_scene scene, rt_snapshot snapshot) {
    Bytes pixels(32 * 24 * 4);
    rt_frame_desc frame = rt_default_frame_desc();
    frame.pixels = pixels.data();
    frame.width = 32;
    frame.height = 24;
    frame.snapshot = snapshot;
    const rt_camera camera = world_camera();
    EXPECT_OK(rt_render_frame(scene, &camera, &frame, nullptr));
    return pixels;
}

TEST(Snapshots, ShowTheWorldAsItWas) {
    WorldGuard world;
    const rt_scene scene = world->scene;
    rt_snapshot before{};
    ASSERT_OK(rt_hold_snapshot(scene, &before));
    const rt_hit old_hit = look_down(scene, nullptr);
    const Bytes old_frame = render_held(scene, {});
    for (int i = 1; i <= 5; ++i) {
        ASSERT_OK(move_lift(*world, 2.0f + float(i)));
        ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
    }
    const rt_query_options options = options_of(before);
    const rt_hit held = look_down(scene, &options);
    const rt_hit now = look_down(scene, nullptr);
    EXPECT_EQ(std::memcmp(&held, &old_hit, sizeof held), 0);
    EXPECT_NE(now.t, old_hit.t);
    EXPECT_EQ(render_held(scene, before), old_frame);
    EXPECT_NE(render_held(scene, {}), old_frame);

    rt_scene_stats stats = rt_default_scene_stats();
    ASSERT_OK(rt_get_scene_stats(scene, &stats));
    EXPECT_EQ(stats.snapshots_alive, 2u);
    ASSERT_OK(rt_release_snapshot(scene, before));
    ASSERT_OK(rt_get_scene_stats(scene, &stats));
    EXPECT_EQ(stats.snapshots_alive, 1u);
}

TEST(Snapshots, AreHeldOnceAHandle) {
    WorldGuard world;
    const rt_scene scene = world->scene;
    rt_snapshot a{}, b{};
    ASSERT_OK(rt_hold_snapshot(scene, &a));
    ASSERT_OK(rt_hold_snapshot(scene, &b));
    ASSERT_OK(move_lift(*world, 7));
    ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
    ASSERT_OK(rt_release_snapshot(scene, a));
    const rt_query_options options = options_of(b);
    EXPECT_NE(look_down(scene, &options).t, look_down(scene, nullptr).t);
    ASSERT_OK(rt_release_snapshot(scene, b));
}

TEST(Snapshots, ThatAreStillHeldGoWithTheScene) {
    WorldGuard world;
    rt_snapshot held{};
    ASSERT_OK(rt_hold_snapshot(world->scene, &held));
    ASSERT_OK(move_lift(*world, 7));
    ASSERT_OK(rt_commit_scene(world->scene, nullptr, nullptr));
} // the address sanitizer looks for leaks

TEST_F(HeldSnapshot, RefusesNonsense) {
    auto out = kUntouched<rt_snapshot>;
    expect_refused(rt_hold_snapshot(scene(), nullptr), RT_ERROR_INVALID_ARGUMENT, "out_snapshot");
    expect_refused(rt_hold_snapshot({}, &out), RT_ERROR_INVALID_HANDLE, "scene");
    expect_refused(rt_release_snapshot(scene(), {}), RT_ERROR_INVALID_HANDLE, "rt_snapshot");
    expect_refused(rt_release_snapshot(scene(), {3, 4}), RT_ERROR_INVALID_HANDLE, "rt_snapshot");
    expect_refused(rt_release_snapshot(scene(), {300, 1}), RT_ERROR_INVALID_HANDLE, "rt_snapshot");

    rt_scene empty;
    const rt_scene_desc desc = rt_default_scene_desc();
    ASSERT_OK(rt_create_scene(&desc, &empty));
    expect_refused(rt_hold_snapshot(empty, &out), RT_ERROR_NOT_COMMITTED, "rt_commit_scene");
    EXPECT_TRUE(untouched(out));
    ASSERT_OK(rt_commit_scene(empty, nullptr, nullptr));
    rt_snapshot foreign{};
    ASSERT_OK(rt_hold_snapshot(empty, &foreign));
    expect_refused(rt_release_snapshot(scene(), foreign), RT_ERROR_INVALID_HANDLE, "rt_snapshot");
    ASSERT_OK(rt_destroy_scene(empty));
}

TEST_F(HeldSnapshot, RefusesStaleHandles) {
    rt_snapshot held{};
    ASSERT_OK(rt_hold_snapshot(scene(), &held));
    ASSERT_OK(rt_release_snapshot(scene(), held));
    expect_refused(rt_release_snapshot(scene(), held), RT_ERROR_INVALID_HANDLE, "rt_snapshot");

    const rt_query_options options = options_of(held);
    const rt_ray ray = {{0, 50, 0}, 0, {0, -1, 0}, kInfinity};
    rt_hit hit{};
    rt_query_desc query = rt_default_query_desc();
    query.rays = &ray;
    query.ray_count = 1;
    query.hits = &hit;
    query.options = &options;
    expect_refused(rt_trace_query(scene(), &query), RT_ERROR_INVALID_HANDLE, "rt_snapshot");

    Bytes pixels(16 * 16 * 4);
    rt_frame_desc frame = rt_default_frame_desc();
    frame.pixels = pixels.data();
    frame.width = frame.height = 16;
    frame.snapshot = held;
    const rt_camera camera = world_camera();
    expect_refused(rt_render_frame(scene(), &camera, &frame, nullptr), RT_ERROR_INVALID_HANDLE,
                   "rt_snapshot");
}

TEST_F(HeldSnapshot, HasALimit) {
    std::array<rt_snapshot, 256> held;
    for (rt_snapshot& snapshot : held) ASSERT_OK(rt_hold_snapshot(scene(), &snapshot));
    auto out = kUntouched<rt_snapshot>;
    expect_refused(rt_hold_snapshot(scene(), &out), RT_ERROR_LIMIT, "256 snapshots");
    EXPECT_TRUE(untouched(out));
    for (const rt_snapshot& snapshot : held) ASSERT_OK(rt_release_snapshot(scene(), snapshot));
    ASSERT_OK(rt_hold_snapshot(scene(), &out));
    ASSERT_OK(rt_release_snapshot(scene(), out));
}

// Threads hold what is current, ask it twice and let it go, while the world moves on: both answers
// are the same, and nothing is freed under them.
TEST(Snapshots, AreHeldWhileTheWorldMoves) {
    WorldGuard world;
    std::atomic<bool> done{false};
    std::atomic<int> differences{0};
    const auto ask = [&] {
        while (!done.load()) {
            rt_snapshot held{};
            EXPECT_OK(rt_hold_snapshot(world->scene, &held));
            const rt_query_options options = options_of(held);
            const rt_hit first = look_down(world->scene, &options);
            std::this_thread::yield();
            const rt_hit second = look_down(world->scene, &options);
            differences += std::memcmp(&first, &second, sizeof first) != 0;
            EXPECT_OK(rt_release_snapshot(world->scene, held));
        }
    };
    {
        std::jthread a(ask), b(ask);
        for (int i = 0; i < 300; ++i) {
            EXPECT_OK(move_lift(*world, 2.0f + 0.01f * float(i)));
            EXPECT_OK(rt_commit_scene(world->scene, nullptr, nullptr));
        }
        done = true;
    }
    EXPECT_EQ(differences, 0);
    rt_scene_stats stats = rt_default_scene_stats();
    EXPECT_OK(rt_get_scene_stats(world->scene, &stats));
    EXPECT_EQ(stats.snapshots_alive, 1u);
}

} // namespace
} // namespace peregrine::test
