// What rays see that leave the scene.
#include "base/error.h"
#include "render_scene.h"

#include <cmath>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using test::Picture;
using test::RenderScene;
using test::take_picture;

constexpr uint32_t kSize = 65;

Camera looking(const Vec3& forward) {
    Camera camera;
    camera.forward = forward;
    camera.up = std::fabs(forward.y) > 0.9f ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
    camera.vertical_fov = 1.9f;
    return camera;
}

scene::Sky gradient() {
    scene::Sky sky;
    sky.kind = scene::SkyKind::gradient;
    sky.zenith = {0.1f, 0.2f, 0.9f};
    sky.horizon = {0.8f, 0.7f, 0.6f};
    sky.ground = {0.3f, 0.1f, 0};
    sky.intensity = 2;
    return sky;
}

Vec3 expected_gradient(const scene::Sky& sky, const Vec3& direction) {
    const float h = glm::normalize(direction).y;
    const Vec3 above = glm::mix(sky.horizon, sky.zenith, h > 0 ? h * (2 - h) : 0.0f);
    return sky.intensity * glm::mix(above, sky.ground, glm::clamp(-8 * h, 0.0f, 1.0f));
}

TEST(Sky, IsAGradientFromTheGroundToTheZenith) {
    RenderScene world;
    world.scene.environment.sky = gradient();
    for (const Vec3& forward : {Vec3(0, 0, -1), Vec3(1, 0.5f, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
        const Camera camera = looking(forward);
        const Picture picture = take_picture(world, camera, kSize, kSize);
        const Pinhole pinhole(camera, kSize, kSize);
        for (uint32_t y = 0; y < kSize; ++y)
            for (uint32_t x = 0; x < kSize; ++x)
                ASSERT_LT(glm::length(picture.at(x, y)
                                      - expected_gradient(gradient(), pinhole.direction(x, y))),
                          1e-5f)
                    << x << " " << y;
    }
}

// Each texel says where it is: u in red, v in green.
base::Handle add_map(RenderScene& world, uint32_t width, uint32_t height) {
    std::vector<float> texels;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            texels.insert(texels.end(), {(float(x) + 0.5f) / float(width),
                                         (float(y) + 0.5f) / float(height), 0, 1});
    return world.add_texture(width, height, texels);
}

TEST(Sky, IsAnEquirectangularImage) {
    constexpr double kPi = 3.14159265358979324, kTurn = 0.7;
    for (const double turn : {0.0, kTurn}) {
        RenderScene world;
        world.scene.environment.sky.kind = scene::SkyKind::texture;
        world.scene.environment.sky.cosine = float(std::cos(turn));
        world.scene.environment.sky.sine = float(std::sin(turn));
        world.scene.sky_texture = add_map(world, 720, 360);
        for (const Vec3& forward : {Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(1, 0.3f, 0),
                                    Vec3(-1, -0.5f, 0.2f), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
            const Camera camera = looking(forward);
            const Picture picture = take_picture(world, camera, kSize, kSize);
            const Pinhole pinhole(camera, kSize, kSize);
            for (uint32_t y = 0; y < kSize; y += 3)
                for (uint32_t x = 0; x < kSize; x += 3) {
                    const math::Vec3d d = glm::normalize(math::Vec3d(pinhole.direction(x, y)));
                    const double u = 0.5 + (std::atan2(d.x, -d.z) + turn) / (2 * kPi);
                    const double v = std::acos(d.y) / kPi;
                    const Vec3 color = picture.at(x, y);
                    const double off = std::fabs(std::remainder(double(color.x) - u, 1));
                    ASSERT_LT(off, 1.01 / 720) << x << " " << y;
                    ASSERT_NEAR(color.y, v, 1.01 / 360) << x << " " << y;
                }
        }
    }
}

TEST(Sky, StandsInMirrors) {
    RenderScene world;
    world.scene.environment.sky = gradient();
    world.scene.environment.ambient = Vec3(0);
    scene::Material mirror;
    mirror.base_color = {0, 0, 0, 1};
    mirror.reflectivity = 1;
    world.add_quad({-9, -1, 9}, {9, -1, 9}, {9, -1, -9}, {-9, -1, -9}, world.add(mirror));
    Frame frame = test::float_frame(kSize, kSize);
    const Camera camera = looking({0, -0.5f, -1});
    const Pinhole pinhole(camera, kSize, kSize);
    const Vec3 down = pinhole.direction(kSize / 2, kSize / 2);
    EXPECT_EQ(take_picture(world, camera, frame).at(kSize / 2, kSize / 2), Vec3(0));
    frame.bounces.max_depth = 1;
    const Vec3 seen = take_picture(world, camera, frame).at(kSize / 2, kSize / 2);
    EXPECT_LT(glm::length(seen - expected_gradient(gradient(), {down.x, -down.y, down.z})), 1e-5f);
}

TEST(Sky, OfATextureThatWasRemovedIsRefused) {
    RenderScene world;
    world.scene.environment.sky.kind = scene::SkyKind::texture;
    world.scene.sky_texture = add_map(world, 4, 2);
    EXPECT_TRUE(world.scene.commit({}).features & scene::kSky);
    world.scene.textures.erase(world.scene.sky_texture);
    world.scene.touch_materials();
    EXPECT_THROW(world.scene.commit({}), base::Error);
    world.scene.environment.sky = {};
    EXPECT_FALSE(world.scene.commit({}).features & scene::kSky);
}

} // namespace
} // namespace peregrine::render
