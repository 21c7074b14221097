// What all that sends paths on has in common.
#include "path_scene.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

TEST(Blending, CoversByItsAlpha) {
    RenderScene world;
    world.scene.environment.ambient = Vec3(0.5f);
    scene::Material material;
    material.blended = material.double_sided = true;
    material.base_color = {0.8f, 0.4f, 0.2f, 0.5f};
    material.emissive = {0, 0, 1};
    const base::Handle half = world.add_texture(2, 1, {1, 1, 1, 0.25f, 1, 1, 1, 1});
    add_floor(world, 10, 1, world.add(material, half));
    add_floor(world, 10, 0, world.add(material));
    add_floor(world, 10, -1, world.add(glowing(Vec3(3))));
    const Vec3 self = Vec3(0.4f, 0.2f, 0.1f) + Vec3(0, 0, 1);
    const Vec3 beneath = self * 0.5f + Vec3(3) * 0.5f;
    const auto look = [&](double x, uint32_t depth) {
        return see(world, looking({x, 2, 0}, 0), depth);
    };
    EXPECT_LT(glm::length(look(-5, 4) - (self * 0.125f + beneath * 0.875f)), 1e-5f);
    EXPECT_LT(glm::length(look(5, 4) - (self * 0.5f + beneath * 0.5f)), 1e-5f);
    EXPECT_LT(glm::length(look(5, 0) - self), 1e-5f) << "opaque without bounces";
}

TEST(Blending, CastsAShadowWhereItCoversHalf) {
    RenderScene world;
    scene::Material white, veil;
    white.double_sided = veil.double_sided = veil.blended = true;
    add_floor(world, 10, 0, world.add(white));
    const base::Handle half = world.add_texture(2, 1, {1, 1, 1, 0.45f, 1, 1, 1, 0.55f});
    add_floor(world, 10, 3, world.add(veil, half));
    scene::Light sun;
    sun.type = scene::LightType::directional;
    world.add(sun);
    EXPECT_GT(see(world, looking({-5, 1, 0}, 0), 0).x, 0);
    EXPECT_EQ(see(world, looking({5, 1, 0}, 0), 0).x, 0);
}

// Where it is equally bright everywhere, nothing shows, whatever it is made of.
TEST(Paths, NeitherMakeNorLoseLight) {
    RenderScene world;
    world.scene.environment = {Vec3(1), Vec3(1)};
    scene::Material coated = pane();
    coated.reflectivity = 0.3f;
    coated.transmission = 0.4f;
    scene::Material gilded = mirror(0.7f, {1, 0.8f, 0.3f});
    scene::Material silvered = mirror(1);
    gilded.base_color = silvered.base_color = math::Vec4(1);
    coated.blended = true;
    coated.base_color.a = 0.7f;
    const scene::Material materials[] = {glass(), glass(2.4f), gilded, pane(), coated, silvered};
    for (int i = 0; i < 6; ++i) {
        const Vec3 at(float(i % 3) * 2 - 3, float(i / 3) * 2 - 2, -6);
        add_box(world, at, at + Vec3(1.4f), world.add(materials[i]));
    }
    for (const uint32_t depth : {0u, 1u, 3u, 8u}) {
        const Picture picture = take_picture(world, Camera(), frame_of(64, depth));
        for (const float value : picture.pixels) {
            ASSERT_LE(value, 1 + 1e-5f) << depth;
            ASSERT_GE(value, 1 - 1e-5f) << depth;
        }
    }
}

// A far place shows what a near one does, and a mesh that moves what one that stands does.
TEST(Paths, AreTheSameFarAwayAndOfMovingMeshes) {
    const auto look = [](const math::Vec3d& shift) {
        RenderScene world;
        world.scene.environment = {Vec3(0.1f), Vec3(0.2f, 0.4f, 0.6f)};
        const auto stand = [&](const std::function<void()>& add) {
            add();
            auto& slot = world.scene.meshes.slots().back();
            slot.object->kind = scene::MeshKind::rigid;
            slot.object->shape = std::make_shared<scene::Shape>();
            math::Affine place;
            place.offset = shift;
            slot.object->stand(place, world.scene.origin());
        };
        stand([&] { add_floor(world, 8, 0, world.add(mirror(0.6f))); });
        stand([&] { add_box(world, {-1, 0.2f, -1}, {0.5f, 2, 1}, world.add(glass())); });
        stand([&] { add_box(world, {1, 0.2f, -2}, {2, 2, 1}, world.add(glowing({1, 0.5f, 0}))); });
        Camera camera;
        camera.position = shift + math::Vec3d(1, 2.5, 5);
        camera.forward = {-0.2f, -0.4f, -1};
        return take_picture(world, camera, frame_of(96, 6));
    };
    const Picture near = look({0, 0, 0}), far = look({3e6, 1e6, -2e6});
    uint32_t different = 0;
    for (uint32_t y = 0; y < 96; ++y)
        for (uint32_t x = 0; x < 96; ++x)
            different += glm::length(near.at(x, y) - far.at(x, y)) > 0.01f;
    EXPECT_LT(different, 20u) << "at edges";
    EXPECT_GT(near.stats.rays_bounced, 96u * 96u / 2);
}

TEST(Paths, AreNotInThePlanOfASceneThatHasNone) {
    RenderScene world;
    add_floor(world, 50, 0, world.add(black()));
    EXPECT_EQ(world.scene.commit({}).features & scene::kPathFeatures, 0u);
    scene::Material material = black();
    material.reflectivity = 0.01f;
    world.add(material); // described, and not shown
    world.scene.touch_materials();
    EXPECT_EQ(world.scene.commit({}).features & scene::kPathFeatures, 0u);
}

} // namespace
} // namespace peregrine::test
