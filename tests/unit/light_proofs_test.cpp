// What commits remember of lights: for which lights, for how long, in how much memory; and that no
// frame shows it.
#include "render_scene.h"

#include <cmath>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using test::Picture;
using test::RenderScene;

scene::CommitOptions proving(float patch_size = 0.5f, uint64_t most_bytes = uint64_t(1) << 26) {
    scene::CommitOptions options;
    options.proofs = {true, most_bytes, patch_size};
    return options;
}

scene::Light lamp(const Vec3& position) {
    scene::Light light;
    light.position = position;
    light.radius = 20;
    light.intensity = Vec3(10);
    return light;
}

Camera from_the_corner() {
    Camera camera;
    camera.position = {-4.5, 3, 4.5};
    camera.forward = {1, -0.6f, -1};
    return camera;
}

//    ________      A floor of single triangles, a wall on it, a lamp on each side, a sun through
//   |  *     |     the open roof.
//   |----    |
//   |______*_|
class Room : public testing::Test {
protected:
    Room() {
        scene::Material material;
        material.double_sided = true;
        const base::Handle white = world_.add(material);
        const auto point = [](int x, int z) { return Vec3(float(x) - 5, 0, float(z) - 5); };
        for (int x = 0; x < 10; x += 2)
            for (int z = 0; z < 10; z += 2)
                world_.add_quad(point(x, z + 2), point(x + 2, z + 2), point(x + 2, z), point(x, z),
                                white);
        world_.add_quad({-5, 0, 0}, {1, 0, 0}, {1, 2, 0}, {-5, 2, 0}, white);
        world_.add_quad({-5, 0, -5}, {5, 0, -5}, {5, 4, -5}, {-5, 4, -5}, white);
        first_ = world_.scene.lights.insert(lamp({-2, 1.5, -2}));
        world_.add(lamp({2, 1, 3}));
        scene::Light sun;
        sun.type = scene::LightType::directional;
        sun.direction = glm::normalize(Vec3(0.4f, -1, 0.3f));
        world_.add(sun);
    }

    scene::CommitReport commit(const scene::CommitOptions& options) {
        return world_.scene.commit(options);
    }

    Picture show() {
        const scene::SnapshotStore::Pin pin(world_.scene.snapshots);
        Frame frame = test::float_frame(96, 64);
        Picture picture{frame.width, frame.height, {}, {}};
        picture.pixels.assign(size_t(frame.width) * frame.height * 4, -1.0f);
        frame.pixels = picture.pixels.data();
        render_frame(*pin.get(), from_the_corner(), frame, world_.scene.scheduler,
                     &world_.scene.memory, &picture.stats);
        return picture;
    }

    // The same scene without what was remembered.
    Picture show_traced() {
        RenderScene& world = world_;
        const scene::SnapshotStore::Pin pin(world.scene.snapshots);
        auto* snapshot = const_cast<scene::Snapshot*>(pin.get());
        const auto& remembered = snapshot->lights;
        snapshot->lights = scene::make_light_set(
            remembered->lights, scene::LightViews(&world.scene.recycled), snapshot->world.bounds,
            world.scene.scheduler, &world.scene.recycled);
        return show();
    }

    void expect_same_as_traced() {
        const Picture remembered = show();
        const Picture traced = show_traced();
        EXPECT_EQ(remembered.pixels, traced.pixels);
        EXPECT_LE(remembered.stats.rays_shadow, traced.stats.rays_shadow);
    }

    RenderScene world_;
    base::Handle first_;
};

TEST_F(Room, LooksTheSameAndTracesLess) {
    const scene::CommitReport report = commit(proving());
    EXPECT_EQ(report.proofs.lights, 3u);
    EXPECT_GT(report.proofs.proofs, 100u);
    EXPECT_GT(report.proofs.bytes, 0u);
    const Picture remembered = show();
    const Picture traced = show_traced();
    EXPECT_EQ(remembered.pixels, traced.pixels);
    EXPECT_LT(remembered.stats.rays_shadow, traced.stats.rays_shadow / 2);
}

TEST_F(Room, NothingIsRememberedUnlessAsked) {
    const scene::CommitReport report = commit({});
    EXPECT_EQ(report.proofs.lights, 0u);
    EXPECT_EQ(report.proofs.proofs, 0u);
    const scene::SnapshotStore::Pin pin(world_.scene.snapshots);
    EXPECT_TRUE(pin.get()->lights->views.empty());
}

TEST_F(Room, LaterCommitsKeepWhatStillHolds) {
    const uint64_t bytes = commit(proving()).proofs.bytes;
    const scene::CommitReport kept = commit({});
    EXPECT_EQ(kept.proofs.lights, 3u);
    EXPECT_EQ(kept.proofs.proofs, 0u);
    EXPECT_EQ(kept.proofs.bytes, bytes);
    expect_same_as_traced();
}

TEST_F(Room, ALampThatMovesIsTracedUntilItRests) {
    commit(proving());
    scene::Light& light = *world_.scene.lights.find(first_);
    for (int i = 0; i < 3; ++i) {
        light.position.x += 0.5;
        const scene::CommitReport moved = commit(proving());
        EXPECT_EQ(moved.proofs.lights, 2u);
        EXPECT_EQ(moved.proofs.proofs, 0u);
        expect_same_as_traced();
    }
    const scene::CommitReport rests = commit(proving());
    EXPECT_EQ(rests.proofs.lights, 3u);
    EXPECT_GT(rests.proofs.proofs, 0u);
    expect_same_as_traced();
    // Brighter, it sees the same triangles; farther reaching, it may see more.
    light.intensity *= 2;
    EXPECT_EQ(commit({}).proofs.lights, 3u);
    light.radius = 40;
    EXPECT_EQ(commit({}).proofs.lights, 2u);
    expect_same_as_traced();
}

TEST_F(Room, LampsThatComeAndGo) {
    commit(proving());
    world_.scene.lights.erase(first_);
    EXPECT_EQ(commit({}).proofs.lights, 2u);
    expect_same_as_traced();
    world_.add(lamp({0, 3, 2})); // in the slot of the one before
    EXPECT_EQ(commit({}).proofs.lights, 2u);
    expect_same_as_traced();
    EXPECT_EQ(commit(proving()).proofs.lights, 3u);
    expect_same_as_traced();
}

TEST_F(Room, NewGeometryIsProvedAnew) {
    commit(proving());
    world_.add_quad({0, 1, 3}, {1, 1, 3}, {1, 1, 2}, {0, 1, 2}, {});
    world_.scene.touch_triangles(scene::MeshKind::fixed);
    EXPECT_EQ(commit({}).proofs.lights, 0u);
    expect_same_as_traced();
    EXPECT_EQ(commit(proving()).proofs.lights, 3u);
    expect_same_as_traced();
}

TEST_F(Room, MemoryIsBounded) {
    uint64_t last = 0;
    for (const uint64_t most :
         {uint64_t(0), uint64_t(1), uint64_t(600), uint64_t(3000), uint64_t(1) << 26}) {
        world_.scene.touch_triangles(scene::MeshKind::fixed);
        const scene::CommitReport report = commit(proving(0.05f, most));
        EXPECT_LE(report.proofs.bytes, most);
        EXPECT_GE(report.proofs.bytes, last);
        last = report.proofs.bytes;
        expect_same_as_traced();
    }
}

TEST_F(Room, OddLamps) {
    for (const Vec3& place : {Vec3(0), Vec3(-5, 0, 0), Vec3(1, 2, 0), Vec3(0, 1e-6f, 0),
                              Vec3(0, -1, 0), Vec3(1e9f, 1e9f, 0), Vec3(0, 1, 0)})
        for (const float radius : {1e-30f, 1.0f, 1e30f}) {
            scene::Light light = lamp(place);
            light.radius = radius;
            const base::Handle odd = world_.scene.lights.insert(light);
            commit(proving(2));
            expect_same_as_traced();
            world_.scene.lights.erase(odd);
        }
}

TEST_F(Room, WhatMovesInBetweenIsAskedFor) {
    const auto mesh = world_.make_mesh({});
    mesh.data->positions = {{-1, 0.7f, 1.5f}, {1, 0.7f, 1.5f}, {0, 0.7f, 3}};
    mesh.surface->triangles = {{0, 1, 2}};
    scene::MeshDescription description{mesh.data};
    description.kind = scene::MeshKind::rigid;
    description.shape = std::make_shared<scene::Shape>();
    for (const double x : {0.0, 1.0, -3.0, 500.0}) {
        math::Affine at;
        at.offset.x = x;
        description.stand(at, {});
        const base::Handle moving = world_.scene.meshes.insert(description);
        commit(proving());
        expect_same_as_traced();
        world_.scene.meshes.erase(moving);
    }
}

scene::CommitOptions proving_for(float ms) {
    scene::CommitOptions options = proving(0.1f);
    options.proofs.budget_ms = ms;
    return options;
}

TEST_F(Room, ABudgetSpreadsProofsOverCommits) {
    const scene::CommitReport whole = commit(proving(0.1f));
    world_.scene.touch_triangles(scene::MeshKind::fixed); // from the beginning
    uint32_t waiting = 3, commits = 0;
    uint64_t tried = 0;
    scene::CommitReport last;
    while (waiting > 0) {
        ASSERT_LT(++commits, 100000u);
        last = commit(proving_for(1e-6f));
        EXPECT_LE(last.proofs.waiting, waiting);
        EXPECT_EQ(last.proofs.waiting + last.proofs.lights, 3u);
        EXPECT_TRUE(last.proofs.waiting == 0 || last.proofs.proofs < whole.proofs.proofs / 2);
        if (commits % 16 == 1) expect_same_as_traced();
        waiting = last.proofs.waiting;
        tried += last.proofs.proofs;
    }
    EXPECT_GT(commits, 20u);
    EXPECT_EQ(tried, whole.proofs.proofs);
    EXPECT_EQ(last.proofs.bytes, whole.proofs.bytes);
    expect_same_as_traced();
    EXPECT_EQ(commit(proving_for(1e-6f)).proofs.proofs, 0u);
    EXPECT_EQ(commit(proving_for(1000)).proofs.waiting, 0u);
}

TEST_F(Room, WhatChangesMidwayIsProvedAnew) {
    const auto finish = [&] {
        for (int i = 0; commit(proving_for(1e-3f)).proofs.waiting > 0; ++i) ASSERT_LT(i, 100000);
        expect_same_as_traced();
    };
    EXPECT_EQ(commit(proving_for(1e-6f)).proofs.waiting, 3u);
    world_.scene.lights.find(first_)->position.x += 0.25; // that one begins again, at rest
    commit(proving_for(1e-6f));
    finish();
    world_.add_quad({-3, 0, 4}, {-3, 0, 3}, {-3, 1, 3}, {-3, 1, 4}, {});
    world_.scene.touch_triangles(scene::MeshKind::fixed);
    EXPECT_EQ(commit(proving_for(1e-6f)).proofs.waiting, 3u);
    world_.scene.lights.erase(first_);
    EXPECT_EQ(commit(proving_for(1e-6f)).proofs.waiting, 2u);
    expect_same_as_traced();
    commit({}); // for once nothing is asked
    expect_same_as_traced();
    finish();
    EXPECT_EQ(commit({}).proofs.lights, 2u);
}

// What was begun goes on after it.
TEST_F(Room, ACancelledCommitDoesNotLoseProofs) {
    commit({});
    scene::CommitOptions options = proving_for(1e-6f);
    int calls = 0;
    options.progress.user = &calls;
    options.progress.function = [](void* user, float) -> int32_t {
        return ++*static_cast<int*>(user) % 7 == 0;
    };
    int cancelled = 0, left = 3;
    for (int i = 0; left > 0; ++i) {
        ASSERT_LT(i, 100000);
        try {
            left = int(commit(options).proofs.waiting);
        } catch (const base::Error&) {
            ++cancelled;
        }
    }
    EXPECT_GT(cancelled, 5);
    expect_same_as_traced();
}

TEST_F(Room, ACommitThatIsCancelledForgetsNothing) {
    const uint64_t bytes = commit(proving()).proofs.bytes;
    world_.add(lamp({0, 3, 2}));
    scene::CommitOptions options = proving();
    options.progress.function = [](void*, float fraction) -> int32_t { return fraction > 0.05f; };
    EXPECT_ANY_THROW(commit(options));
    EXPECT_EQ(commit({}).proofs.bytes, bytes);
    expect_same_as_traced();
}

} // namespace
} // namespace peregrine::render
