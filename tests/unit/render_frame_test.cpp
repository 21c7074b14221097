#include "render_scene.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using test::glowing;
using test::RenderScene;
using test::take_picture;

scene::Material white() {
    scene::Material material;
    material.double_sided = true;
    return material;
}

//      +y            looking along -z from the origin: +x is right, +y is up, row 0 is the top
//       B
//   ----+----A +x
TEST(CameraView, HasPlusXRightAndPlusYUp) {
    RenderScene world;
    world.add_triangle({4, -1, -10}, {5, -1, -10}, {4.5f, 1, -10}, world.add(glowing({1, 0, 0})));
    world.add_triangle({-1, 4, -10}, {1, 4, -10}, {0, 5, -10}, world.add(glowing({0, 1, 0})));
    const test::Picture picture = take_picture(world, Camera{}, 200, 200);
    const float half = 100 / (10 * std::tan(0.5f * 1.0471976f)); // pixels a metre at z = -10
    EXPECT_EQ(picture.at(uint32_t(100 + 4.5f * half), 100), Vec3(1, 0, 0));
    EXPECT_EQ(picture.at(100, uint32_t(100 - 4.3f * half)), Vec3(0, 1, 0));
    EXPECT_EQ(picture.at(uint32_t(100 - 4.5f * half), 100), Vec3(0));
    EXPECT_EQ(picture.at(100, uint32_t(100 + 4.3f * half)), Vec3(0));
}

TEST(CameraView, TakesForwardAndUpOfAnyLengthAndLean) {
    Camera camera;
    camera.forward = {0, 0, -20};
    camera.up = {0, 0.1f, 3};
    const Pinhole leaning(camera, 40, 30), straight(Camera{}, 40, 30);
    for (const uint32_t y : {0u, 17u, 29u})
        for (const uint32_t x : {0u, 23u, 39u}) {
            const Vec3 difference = leaning.direction(x, y) - straight.direction(x, y);
            EXPECT_LT(glm::dot(difference, difference), 1e-12f);
        }
    EXPECT_NEAR(straight.direction(0, 0).y / straight.direction(0, 29).y, -1.0, 1e-5);
    EXPECT_NEAR(straight.direction(39, 9).x / straight.direction(0, 9).x, -1.0, 1e-5);
}

// A level with everything in it: textures, normal maps, gloss, masks, all types of lights.
void furnish(RenderScene& world) {
    std::vector<float> bumps, checks;
    for (int i = 0; i < 64; ++i) {
        const auto tilt = float(i % 7) / 14.0f;
        bumps.insert(bumps.end(), {0.5f + tilt * 0.3f, 0.6f - tilt * 0.4f, 0.95f, 1});
        const float on = (i ^ i >> 3) & 1 ? 1.0f : 0.2f;
        checks.insert(checks.end(), {on, 1 - on, 0.5f, on});
    }
    const base::Handle normals = world.add_texture(8, 8, bumps);
    const base::Handle checker = world.add_texture(8, 8, checks);
    scene::Material floor = white();
    floor.specular = Vec3(0.3f);
    floor.base_color_texture.row_u.x = 3;
    const base::Handle tiled = world.add(floor, checker, normals);
    scene::Material grate = white();
    grate.masked = true;
    grate.double_sided = false;
    const base::Handle masked = world.add(grate, checker);
    scene::Material lamp = white();
    lamp.emissive = {2, 1, 0.5f};
    const base::Handle glow = world.add(lamp, {}, {}, checker);
    world.add_quad({-5, -1, 5}, {5, -1, 5}, {5, -1, -15}, {-5, -1, -15}, tiled);
    world.add_quad({-5, -1, -9}, {5, -1, -9}, {5, 6, -9}, {-5, 6, -9}, tiled);
    world.add_quad({-2, -0.5f, -5}, {1, -0.5f, -5}, {1, 2, -5.5f}, {-2, 2, -5.5f}, masked);
    world.add_quad({2, 0, -6}, {3, 0, -6}, {3, 1, -6}, {2, 1, -6}, glow);

    const auto ball = world.make_mesh(world.add(floor));
    for (int i = 0; i <= 16; ++i)
        for (int j = 0; j <= 16; ++j) {
            const float a = float(i) * 0.19635f, b = float(j) * 0.3927f;
            const Vec3 n(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
            ball.data->positions.push_back(Vec3(-2.5f, 0.2f, -6) + n);
            ball.data->normals.push_back(n);
        }
    for (uint32_t i = 0; i < 16; ++i)
        for (uint32_t j = 0; j < 16; ++j) {
            const uint32_t k = i * 17 + j;
            ball.surface->triangles.push_back({k, k + 1, k + 18});
            ball.surface->triangles.push_back({k, k + 18, k + 17});
        }
    world.scene.meshes.insert({ball.data});

    scene::Light light;
    light.position = {1, 3, -2};
    light.intensity = {20, 18, 15};
    world.add(light);
    light.type = scene::LightType::spot;
    light.position = {-3, 4, -4};
    light.direction = glm::normalize(Vec3(0.2f, -1, -0.4f));
    light.intensity = {10, 30, 40};
    light.cone_inner_cos = 0.95f;
    light.cone_outer_cos = 0.8f;
    world.add(light);
    light.type = scene::LightType::directional;
    light.direction = glm::normalize(Vec3(-1, -2, -1));
    light.intensity = Vec3(0.5f);
    world.add(light);
    world.scene.environment.ambient = Vec3(0.05f);
    world.scene.environment.background = {0.2f, 0.3f, 0.4f};
}

TEST(RenderFrame, IsTheSameForAnyNumberOfThreads) {
    RenderScene one(1), two(2), three(3);
    for (RenderScene* world : {&one, &two, &three}) furnish(*world);
    const test::Picture picture = take_picture(one, Camera{}, 150, 133);
    EXPECT_GT(picture.stats.rays_shadow, 1000u);
    EXPECT_EQ(picture.pixels, take_picture(two, Camera{}, 150, 133).pixels);
    EXPECT_EQ(picture.pixels, take_picture(three, Camera{}, 150, 133).pixels);
    for (const float value : picture.pixels) ASSERT_TRUE(value >= 0 && value < 100);
}

TEST(RenderFrame, IsTheSameForEveryInstructionSet) {
    RenderScene plain(1, base::Isa::scalar);
    furnish(plain);
    for (const View view : {View::shaded, View::normals, View::depth}) {
        Frame frame = test::float_frame(150, 133);
        frame.view = view;
        const test::Picture expected = take_picture(plain, Camera{}, frame);
        for (const base::Isa isa : {base::Isa::sse4, base::Isa::avx2, base::Isa::avx512}) {
            if (!base::is_available(isa)) continue;
            RenderScene world(1, isa);
            furnish(world);
            const test::Picture picture = take_picture(world, Camera{}, frame);
            EXPECT_EQ(picture.stats.isa, isa);
            EXPECT_EQ(picture.pixels, expected.pixels) << int(isa);
            EXPECT_EQ(picture.stats.rays_shadow, expected.stats.rays_shadow);
        }
    }
}

//  A camera within a slab of a wall, at corners, on edges and in the planes of its faces.
TEST(RenderFrame, FromInsideAWall) {
    for (const Vec3& eye :
         {Vec3(0, 1, -9.05f), Vec3(0, 1, -9), Vec3(-5, -1, -9), Vec3(0, -1, 0), Vec3(0, -1, -9)}) {
        Camera camera;
        camera.position = eye;
        test::Picture expected;
        for (const base::Isa isa :
             {base::Isa::scalar, base::Isa::sse4, base::Isa::avx2, base::Isa::avx512}) {
            if (!base::is_available(isa)) continue;
            RenderScene world(1, isa);
            furnish(world);
            world.add_quad({-5, -1, -9.1f}, {5, -1, -9.1f}, {5, 6, -9.1f}, {-5, 6, -9.1f},
                           world.add(white()));
            const test::Picture picture = take_picture(world, camera, 70, 50);
            if (isa == base::Isa::scalar) expected = picture;
            EXPECT_EQ(picture.pixels, expected.pixels) << int(isa);
            for (const float value : picture.pixels) ASSERT_TRUE(value >= 0 && value < 1000);
        }
    }
}

TEST(RenderFrame, DoesNotDependOnHowTilesCutTheImage) {
    RenderScene world;
    furnish(world);
    // The same pixels, asked for singly: a camera turned by an exact power of two cannot do that,
    // but a smaller image with the same pixel grid can: the middle of 96 rows is that of 32.
    Camera narrow, wide;
    wide.vertical_fov = 2 * std::atan(3 * std::tan(narrow.vertical_fov / 2));
    const test::Picture small = take_picture(world, narrow, 32, 32);
    const test::Picture large = take_picture(world, wide, 96, 96);
    double difference = 0;
    for (uint32_t y = 0; y < 32; ++y)
        for (uint32_t x = 0; x < 32; ++x)
            difference += double(glm::length(small.at(x, y) - large.at(x + 32, y + 32)));
    EXPECT_LT(difference / (32 * 32), 1e-3);
}

TEST(RenderFrame, AllocatesOnceAFrameAndNotPerTile) {
    RenderScene world(2);
    furnish(world);
    take_picture(world, Camera{}, 8, 8);
    const scene::SnapshotStore::Pin pin(world.scene.snapshots);
    Frame frame = test::float_frame(300, 300);
    std::vector<float> pixels(300 * 300 * 4);
    frame.pixels = pixels.data();
    const uint64_t before = world.scene.memory.allocations();
    const uint64_t bytes = world.scene.memory.bytes();
    render_frame(*pin.get(), Camera{}, frame, world.scene.scheduler, &world.scene.memory, nullptr);
    EXPECT_EQ(world.scene.memory.allocations() - before, 2u) << "numbers of lights, and workers";
    EXPECT_EQ(world.scene.memory.bytes(), bytes);
}

TEST(Views, ShowNormalsDepthAndSteps) {
    RenderScene world;
    world.add_quad({-9, -9, -10}, {9, -9, -10}, {9, 0, -10}, {-9, 0, -10}, world.add(white()));
    Frame frame = test::float_frame(33, 33);
    frame.view = View::normals;
    const test::Picture normals = take_picture(world, Camera{}, frame);
    EXPECT_EQ(normals.at(16, 30), Vec3(0.5f, 0.5f, 1.0f));
    EXPECT_EQ(normals.at(16, 2), Vec3(0));
    frame.view = View::depth;
    frame.depth_range = 40;
    const test::Picture depth = take_picture(world, Camera{}, frame);
    EXPECT_NEAR(depth.at(16, 17).x, 0.75f, 1e-3f);
    EXPECT_EQ(depth.at(16, 2), Vec3(0));
    frame.view = View::steps;
    frame.steps_range = 1e-3f;
    EXPECT_EQ(take_picture(world, Camera{}, frame).at(16, 17), Vec3(1));
}

} // namespace
} // namespace peregrine::render
