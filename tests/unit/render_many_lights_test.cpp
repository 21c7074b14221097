// Frames of many lights: the tree of lights changes no bit of them; commits share it and build it.
#include "render_scene.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using math::Vec3d;
using test::Picture;
using test::RenderScene;

class Random {
public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    float operator()(float from, float to) {
        return std::uniform_real_distribution<float>(from, to)(engine_);
    }
    uint32_t below(uint32_t end) { return uint32_t(engine_() % end); }

private:
    std::mt19937 engine_;
};

// Some of them on and inside the walls.
scene::Light random_light(Random& random, const Vec3d& place) {
    scene::Light light;
    light.type = scene::LightType(random.below(20) == 0 ? 2 : random.below(2));
    light.position = {random(-6, 6), random.below(8) == 0 ? 0 : random(-0.5f, 4), random(-6, 6)};
    light.position += place;
    light.direction = glm::normalize(Vec3(random(-1, 1), random(-2, 0.1f), random(-1, 1)));
    light.falloff = scene::Falloff(random.below(scene::kFalloffCount));
    light.radius = random(0.2f, 3);
    if (random.below(30) == 0) light.radius = random.below(2) == 0 ? 1e-30f : 1e30f;
    if (is_inverse_square(light.falloff) && random.below(30) == 0)
        light.radius = std::numeric_limits<float>::infinity();
    light.intensity = {random(0, 1), random(0, 1), random(0, 1)};
    light.cone_outer_cos = random(-0.5f, 0.9f);
    light.casts_shadow = random.below(4) != 0;
    return light;
}

//    _________      A floor, walls on it, and what does not move but could; shiny or not.
//   | |   ___ |
//   |_|______ |
class LightRooms {
public:
    LightRooms(uint32_t lights, const Vec3d& place, bool shiny) : place_(place) {
        scene::Material material;
        material.double_sided = true;
        if (shiny) material.specular = Vec3(0.3f);
        const base::Handle white = world.add(material);
        const Vec3 p(place);
        const auto quad = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
            world.add_quad(p + corner, p + corner + u, p + corner + u + v, p + corner + v, white);
        };
        quad({-6, 0, -6}, {0, 0, 12}, {12, 0, 0});
        quad({-6, 0, -6}, {12, 0, 0}, {0, 4, 0});
        quad({-2, 0, -3}, {0, 0, 5}, {0, 2, 0});
        quad({1, 1, -2}, {4, 0, 0}, {0, 0, 3});
        if (place != Vec3d(0)) add_crate();
        Random random(lights);
        for (uint32_t i = 0; i < lights; ++i)
            handles.push_back(world.scene.lights.insert(random_light(random, place)));
    }

    Picture show(float least_light = 0) {
        const scene::SnapshotStore::Pin pin(world.scene.snapshots);
        Camera camera;
        camera.position = place_ + Vec3d(-5, 3.5, 5.5);
        camera.forward = {1, -0.5f, -1};
        Frame frame = test::float_frame(97, 65);
        frame.approximations.least_light = least_light;
        Picture picture{frame.width, frame.height, {}, {}};
        picture.pixels.assign(size_t(frame.width) * frame.height * 4, -1.0f);
        frame.pixels = picture.pixels.data();
        render_frame(*pin.get(), camera, frame, world.scene.scheduler, &world.scene.memory,
                     &picture.stats);
        return picture;
    }

    // The same snapshot, each batch asking all of its lights.
    Picture show_without_tree() {
        const scene::SnapshotStore::Pin pin(world.scene.snapshots);
        auto* snapshot = const_cast<scene::Snapshot*>(pin.get());
        const std::shared_ptr<const scene::LightSet> set = snapshot->lights;
        const auto all = std::make_shared<scene::LightSet>(*set);
        all->tree.levels = 0;
        all->beside.clear();
        for (uint32_t i = 0; i < set->lights.size(); ++i) all->beside.push_back(i);
        snapshot->lights = all;
        Picture picture = show();
        snapshot->lights = set;
        return picture;
    }

    bool has_tree() {
        const scene::SnapshotStore::Pin pin(world.scene.snapshots);
        return pin.get()->lights->tree.levels > 0;
    }
    const scene::LightSet* set() {
        const scene::SnapshotStore::Pin pin(world.scene.snapshots);
        return pin.get()->lights.get();
    }

    RenderScene world;
    std::vector<base::Handle> handles;

private:
    // A mesh that keeps its precision far away: frames shade relative to the eye there.
    void add_crate() {
        const auto mesh = world.make_mesh({});
        mesh.data->positions = {{-1, 0, 1}, {1, 0, 1}, {0, 1.5f, 0}};
        mesh.surface->triangles = {{0, 1, 2}};
        scene::MeshDescription description{mesh.data};
        description.kind = scene::MeshKind::rigid;
        description.shape = std::make_shared<scene::Shape>();
        math::Affine at;
        at.offset = place_;
        description.stand(at, {});
        world.scene.meshes.insert(description);
    }

    Vec3d place_;
};

TEST(ManyLights, TheTreeChangesNoBit) {
    for (const bool shiny : {false, true})
        for (const uint32_t count : {20u, 33u, 150u, 700u})
            for (const double far : {0.0, 3000.0, 2e6}) {
                LightRooms rooms(count, {far, 0, -far / 2}, shiny);
                rooms.world.scene.commit({});
                EXPECT_EQ(rooms.has_tree(), count > 32);
                const Picture with = rooms.show(), without = rooms.show_without_tree();
                EXPECT_EQ(with.pixels, without.pixels) << count << " " << far;
                EXPECT_EQ(with.stats.rays_shadow, without.stats.rays_shadow);
                EXPECT_GT(with.stats.rays_shadow, 0u);
            }
}

TEST(ManyLights, CommitsShareWhatDidNotChange) {
    LightRooms rooms(200, {}, false);
    rooms.world.scene.commit({});
    const scene::LightSet* const first = rooms.set();
    rooms.world.scene.environment.ambient = Vec3(0.5f);
    rooms.world.scene.commit({});
    EXPECT_EQ(rooms.set(), first);
    // Another wall, within the bounds of the others.
    rooms.world.add_quad({0, 1, 3}, {1, 1, 3}, {1, 1, 2}, {0, 1, 2}, {});
    rooms.world.scene.touch_triangles(scene::MeshKind::fixed);
    rooms.world.scene.commit({});
    EXPECT_EQ(rooms.set(), first);
    rooms.world.scene.lights.find(rooms.handles[77])->position.y += 0.01;
    rooms.world.scene.commit({});
    EXPECT_NE(rooms.set(), first);
    EXPECT_EQ(rooms.show().pixels, rooms.show_without_tree().pixels);
    // A world so large that lights which were outside are inside.
    rooms.world.add_quad({0, -9, 90}, {90, 99, 90}, {90, 99, -90}, {0, -9, -90}, {});
    rooms.world.scene.touch_triangles(scene::MeshKind::fixed);
    rooms.world.scene.commit({});
    EXPECT_EQ(rooms.show().pixels, rooms.show_without_tree().pixels);
    for (const scene::PreparedLight& light : rooms.set()->prepared)
        EXPECT_EQ(light.from_light, is_near(rooms.set()->lights[&light - &rooms.set()->prepared[0]],
                                            {{-6, -9, -90}, {90, 99, 90}}));
}

TEST(ManyLights, LightsThatComeAndGo) {
    LightRooms rooms(300, {}, false);
    Random random(5);
    for (int i = 0; i < 20; ++i) {
        for (base::Handle& handle : rooms.handles) {
            if (random.below(3) != 0) continue;
            if (rooms.world.scene.lights.erase(handle)) continue;
            handle = rooms.world.scene.lights.insert(random_light(random, {}));
        }
        rooms.world.scene.commit({});
        ASSERT_EQ(rooms.show().pixels, rooms.show_without_tree().pixels);
    }
}

// As many steps as a display shows of a value.
double code(double x) {
    x = std::clamp(x, 0.0, 1.0);
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

TEST(LeastLight, LeavesOutNoMoreThanItsSteps) {
    for (const float ambient : {0.0f, 0.1f})
        for (const bool shiny : {false, true}) {
            LightRooms rooms(700, {}, shiny);
            rooms.world.scene.environment.ambient = Vec3(ambient);
            rooms.world.scene.commit({});
            const Picture exact = rooms.show();
            uint64_t last = exact.stats.rays_shadow;
            for (const float steps : {1e-6f, 0.5f, 2.0f, 10.0f, 1000.0f}) {
                const Picture picture = rooms.show(steps);
                for (size_t i = 0; i < exact.pixels.size(); ++i) {
                    const double before = code(double(exact.pixels[i]));
                    const double after = code(double(picture.pixels[i]));
                    ASSERT_LE(after, before + 1e-4);
                    ASSERT_LE(before - after, double(steps) * 1.001 + 1e-4) << ambient << shiny;
                }
                EXPECT_LE(picture.stats.rays_shadow, last);
                last = picture.stats.rays_shadow;
            }
            EXPECT_LT(last, exact.stats.rays_shadow);
        }
}

} // namespace
} // namespace peregrine::render
