#include "render_scene.h"
#include <cmath>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using test::RenderScene;
using test::take_picture;

scene::Material matt(bool double_sided = true) {
    scene::Material material;
    material.double_sided = double_sided;
    return material;
}

scene::Light lamp(const Vec3& position, float radius, float candela) {
    scene::Light light;
    light.position = position;
    light.radius = radius;
    light.intensity = Vec3(candela);
    return light;
}

// From above onto the floor y = 0.
Camera above(double height) {
    Camera camera;
    camera.position = {0, height, 0};
    camera.forward = {0, -1, 0};
    camera.up = {0, 0, -1};
    return camera;
}

void add_floor(RenderScene& world, float size, base::Handle material, const Vec3& shift = Vec3(0)) {
    world.add_quad(shift + Vec3(-size, 0, size), shift + Vec3(size, 0, size),
                   shift + Vec3(size, 0, -size), shift + Vec3(-size, 0, -size), material);
}

TEST(PointLight, LightsAFloorByItsFalloffAndCosine) {
    RenderScene world;
    add_floor(world, 10, world.add(matt()));
    world.add(lamp({0, 2, 0}, 8, 30));
    const test::Picture picture = take_picture(world, above(5), 64, 64);
    const Pinhole pinhole(above(5), 64, 64);
    for (const uint32_t x : {0u, 10u, 31u, 50u}) {
        const Vec3 direction = pinhole.direction(x, 31);
        const Vec3 point = Vec3(0, 5, 0) + direction * (-5.0f / direction.y);
        const float d = glm::length(Vec3(0, 2, 0) - point);
        const float window = 1 - std::pow(d / 8, 4.0f);
        const float expected = 30 * window / (d * d) * (2 / d) / 3.14159265f;
        EXPECT_NEAR(picture.at(x, 31).x / expected, 1.0f, 1e-4f);
    }
}

TEST(PointLight, EndsAtItsRadius) {
    RenderScene world;
    add_floor(world, 10, world.add(matt()));
    world.add(lamp({0, 2, 0}, 3, 30));
    const test::Picture picture = take_picture(world, above(9), 128, 128);
    EXPECT_GT(picture.at(64, 64).x, 0.0f);
    EXPECT_EQ(picture.at(0, 64).x, 0.0f);
    EXPECT_LT(picture.stats.rays_shadow, 128u * 128u / 4) << "culled by its radius";
}

TEST(SpotLight, IsFullInsideAndDarkOutsideItsCone) {
    RenderScene world;
    add_floor(world, 10, world.add(matt()));
    scene::Light spot = lamp({0, 4, 0}, 20, 50);
    spot.type = scene::LightType::spot;
    spot.direction = {0, -1, 0};
    spot.cone_inner_cos = std::cos(0.2f);
    spot.cone_outer_cos = std::cos(0.4f);
    world.add(spot);
    const test::Picture cone = take_picture(world, above(10), 101, 101);
    RenderScene all_round;
    add_floor(all_round, 10, all_round.add(matt()));
    all_round.add(lamp({0, 4, 0}, 20, 50));
    const test::Picture bulb = take_picture(all_round, above(10), 101, 101);
    EXPECT_FLOAT_EQ(cone.at(50, 50).x, bulb.at(50, 50).x);
    EXPECT_EQ(cone.at(5, 50).x, 0.0f);
    float previous = 1;
    for (uint32_t x = 50; x < 75; ++x) { // never brighter outward, and no step
        const float part = cone.at(x, 50).x / bulb.at(x, 50).x;
        EXPECT_LE(part, previous + 1e-5f);
        EXPECT_GT(part, previous - 0.25f);
        previous = part;
    }
}

TEST(DirectionalLight, HasLuxForUnit) {
    RenderScene world;
    add_floor(world, 10, world.add(matt()));
    scene::Light sun;
    sun.type = scene::LightType::directional;
    sun.direction = glm::normalize(Vec3(1, -1, 0));
    sun.intensity = Vec3(3.14159265f);
    world.add(sun);
    EXPECT_NEAR(take_picture(world, above(5)).at(20, 20).x, std::sqrt(0.5f), 1e-5f);
}

//        * light
//      -----  blocker
//   ___________  floor
TEST(Shadows, ABlockerDarkensAndTheFrameMayLeaveShadowsOut) {
    RenderScene world;
    add_floor(world, 10, world.add(matt()));
    add_floor(world, 0.5f, world.add(matt()), {0, 1, 0});
    world.add(lamp({0, 3, 0}, 20, 50));
    Camera camera;
    camera.position = {0, 2, 6};
    camera.forward = {0, -2, -6};
    Frame frame = test::float_frame(65, 65);
    const auto floor_in_front = [&](const test::Picture& picture) { return picture.at(32, 33).x; };
    const float dark = floor_in_front(take_picture(world, camera, frame));
    frame.shadows = false;
    const test::Picture lit = take_picture(world, camera, frame);
    EXPECT_EQ(dark, 0.0f);
    EXPECT_GT(floor_in_front(lit), 0.0f);
    EXPECT_EQ(lit.stats.rays_shadow, 0u);
}

// No pixel of a flat wall may shadow itself, whatever the scale, the place and the angle.
TEST(Shadows, AFlatPlaneNeverShadowsItself) {
    for (const float scale : {1e-3f, 1.0f, 100.0f, 1e4f})
        for (const float offset : {0.0f, 30.0f})
            for (const float lean : {0.0f, 0.3f}) {
                RenderScene world;
                const Vec3 shift = Vec3(offset, offset * 0.7f, -offset) * scale;
                const Vec3 right = glm::normalize(Vec3(1, lean, 0.1f)) * scale * 10.0f;
                const Vec3 back = glm::normalize(Vec3(0.2f, -lean, -1)) * scale * 10.0f;
                const Vec3 up = glm::normalize(glm::cross(right, back));
                world.add_quad(shift - right - back, shift + right - back, shift + right + back,
                               shift - right + back, world.add(matt()));
                for (const float height : {0.02f, 1.0f, 5.0f})
                    world.add(lamp(shift + up * (height * scale), 30 * scale, scale * scale));
                Camera camera;
                camera.position = math::Vec3d(shift + up * (8 * scale));
                camera.forward = -up;
                camera.up = back;
                Frame frame = test::float_frame(96, 96);
                const test::Picture with = take_picture(world, camera, frame);
                EXPECT_GT(with.stats.rays_shadow, 96u * 96u);
                frame.shadows = false;
                EXPECT_EQ(with.pixels, take_picture(world, camera, frame).pixels)
                    << scale << " " << offset << " " << lean;
            }
}

TEST(Shadows, ContactHasNoGap) {
    RenderScene world; // a box's wall stands on the floor; the light is behind it
    add_floor(world, 10, world.add(matt()));
    world.add_quad({-10, 0, 0}, {10, 0, 0}, {10, 4, 0}, {-10, 4, 0}, world.add(matt()));
    world.add(lamp({0, 2, -2}, 20, 50));
    Camera camera;
    camera.position = {0, 2, 0.02};
    camera.forward = {0, -1, 0};
    camera.up = {0, 0, -1};
    camera.vertical_fov = 0.018f; // 2 cm of floor before the wall
    const test::Picture picture = take_picture(world, camera, 64, 64);
    for (uint32_t y = 0; y < 64; ++y)
        for (uint32_t x = 0; x < 64; ++x) ASSERT_EQ(picture.at(x, y).x, 0.0f) << x << " " << y;
}

// A mask whose left half is absent, between eye and floor as well as between light and floor.
TEST(AlphaMask, IsSeenThroughByPrimaryAndShadowRays) {
    RenderScene world;
    const base::Handle half = world.add_texture(2, 1, {1, 1, 1, 0, 1, 1, 1, 1});
    scene::Material grate = matt();
    grate.masked = true;
    grate.base_color = {1, 0, 0, 1};
    add_floor(world, 10, world.add(matt()));
    add_floor(world, 2, world.add(grate, half), {0, 1, 0});
    world.add(lamp({0, 3, 0}, 20, 50));
    const test::Picture picture = take_picture(world, above(6), 64, 64);
    const Vec3 absent = picture.at(26, 32), present = picture.at(38, 32);
    EXPECT_GT(absent.y, 0.0f) << "the white floor, lit through the hole";
    EXPECT_EQ(present.y, 0.0f) << "the red grate";
    EXPECT_GT(present.x, 0.0f);
    EXPECT_GT(picture.at(6, 32).x, 0.0f) << "floor on the side of the hole, lit through it";
    EXPECT_EQ(picture.at(57, 32).x, 0.0f) << "floor in the shadow of the solid half";
}

TEST(Faces, SingleSidedBacksAreNotShownButCastShadows) {
    RenderScene world;
    add_floor(world, 10, world.add(matt()));
    // Faces down: from above it is seen from behind.
    world.add_quad({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}, world.add(matt(false)));
    world.add(lamp({6, 3, 0}, 20, 50));
    Frame frame = test::float_frame(64, 64);
    frame.view = View::depth;
    const test::Picture depth = take_picture(world, above(5), frame);
    EXPECT_NEAR(depth.at(32, 32).x, 1 - 5 / 50.0f, 1e-3f) << "the floor, not the quad";
    frame.view = View::shaded;
    frame.shadows = false;
    const test::Picture lit = take_picture(world, above(5), frame);
    frame.shadows = true;
    const test::Picture shadowed = take_picture(world, above(5), frame);
    EXPECT_NE(lit.pixels, shadowed.pixels);
}

TEST(Faces, BacksOfDoubleSidedSurfacesAreLitFromTheViewersSide) {
    RenderScene world;
    world.add_quad({-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}, world.add(matt())); // faces down
    world.add(lamp({0, 2, 0}, 8, 30));
    Frame frame = test::float_frame(16, 16);
    EXPECT_GT(take_picture(world, above(5), frame).at(8, 8).x, 0.1f);
    frame.view = View::normals;
    EXPECT_EQ(take_picture(world, above(5), frame).at(8, 8), Vec3(0.5f, 1, 0.5f));
}

// Texels that lean toward the right of the image (+X) and its top (+Y, toward v = 0), with tangents
// from the coordinates and from the mesh, seen from both sides.
TEST(NormalMap, LeansAsTheImageSays) {
    for (const bool with_tangents : {false, true})
        for (const bool from_behind : {false, true}) {
            RenderScene world;
            const base::Handle map = world.add_texture(1, 1, {0.8f, 0.9f, 0.5f, 1});
            const auto mesh = world.make_mesh(world.add(matt(), {}, map));
            // v grows downward in the image: its top edge is at -z.
            mesh.data->positions = {{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}};
            mesh.surface->texcoords = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
            mesh.surface->triangles = {{0, 1, 2}, {0, 2, 3}};
            if (with_tangents) mesh.data->tangents.assign(4, math::Vec4(1, 0, 0, 1));
            world.scene.meshes.insert({mesh.data});
            Frame frame = test::float_frame(16, 16);
            frame.view = View::normals;
            const double side = from_behind ? -1 : 1;
            Camera camera = above(5 * side);
            camera.forward.y = float(-side);
            const Vec3 n = take_picture(world, camera, frame).at(8, 8) * 2.0f - 1.0f;
            const Vec3 front = glm::normalize(Vec3(0.6f, 0, -0.8f)); // texel: x .6, y .8, z 0
            const Vec3 expected = from_behind ? -front : front;
            EXPECT_LT(glm::length(n - expected), 1e-3f) << with_tangents << from_behind;
        }
}

TEST(Specular, TheHighlightLiesWhereTheViewIsMirrored) {
    RenderScene world;
    scene::Material gloss = matt();
    gloss.base_color = {0, 0, 0, 1};
    gloss.specular = Vec3(1);
    gloss.shininess = 64;
    add_floor(world, 10, world.add(gloss));
    world.add(lamp({0, 5, 0}, 20, 50));
    const test::Picture picture = take_picture(world, above(5), 65, 65);
    const float middle = picture.at(32, 32).x;
    EXPECT_GT(middle, picture.at(36, 32).x);
    EXPECT_GT(picture.at(36, 32).x, picture.at(60, 32).x);
    EXPECT_NEAR(picture.at(28, 32).x, picture.at(36, 32).x, 1e-3f * middle);
}

// A coarse sphere with smooth normals, lit from the side: brightness falls from the lit pole to the
// terminator without holes.
TEST(Terminator, FadesOutWithoutSpeckles) {
    RenderScene world;
    const auto ball = world.make_mesh(world.add(matt()));
    for (int i = 0; i <= 12; ++i)
        for (int j = 0; j <= 12; ++j) {
            const float a = float(i) * 0.261799f, b = float(j) * 0.523599f;
            const Vec3 n(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
            ball.data->positions.push_back(n);
            ball.data->normals.push_back(n);
        }
    for (uint32_t i = 0; i < 12; ++i)
        for (uint32_t j = 0; j < 12; ++j) {
            const uint32_t k = i * 13 + j;
            ball.surface->triangles.push_back({k, k + 14, k + 1});
            ball.surface->triangles.push_back({k, k + 13, k + 14});
        }
    world.scene.meshes.insert({ball.data});
    scene::Light sun;
    sun.type = scene::LightType::directional;
    sun.direction = {-1, 0, 0};
    world.add(sun);
    Camera camera;
    camera.position = {0, 0, 4};
    camera.vertical_fov = 0.5f;
    const test::Picture picture = take_picture(world, camera, 128, 128);
    for (uint32_t y = 50; y < 78; ++y)
        for (uint32_t x = 68; x + 1 < 118; ++x) {
            const float left = picture.at(x, y).x, right = picture.at(x + 1, y).x;
            ASSERT_GE(right, left - 0.03f) << x << " " << y;
            ASSERT_LT(right - left, 0.08f) << x << " " << y;
        }
}

} // namespace
} // namespace peregrine::render
