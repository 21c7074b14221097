// Mirrors and glass against the formulas, in doubles.
#include "render_scene.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using test::Picture;
using test::RenderScene;

constexpr double kDegree = 0.017453292519943295;

scene::Material black() {
    scene::Material material;
    material.base_color = {0, 0, 0, 1};
    material.double_sided = true;
    return material;
}

scene::Material glowing(const Vec3& radiance) {
    scene::Material material = black();
    material.emissive = radiance;
    return material;
}

scene::Material mirror(float reflectivity, const Vec3& color = Vec3(1)) {
    scene::Material material = black();
    material.reflectivity = reflectivity;
    material.reflection_color = color;
    return material;
}

scene::Material glass(float index = 1.5f) {
    scene::Material material;
    material.transmission = 1;
    material.index_of_refraction = index;
    return material;
}

scene::Material pane() {
    scene::Material material = glass();
    material.thin = true;
    material.double_sided = true;
    return material;
}

// Faces outward.
void add_box(RenderScene& world, const Vec3& lower, const Vec3& upper, base::Handle material) {
    const auto mesh = world.make_mesh(material);
    for (int i = 0; i < 8; ++i)
        mesh.data->positions.push_back(
            {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
    mesh.surface->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                               {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    world.scene.meshes.insert({mesh.data});
}

// A horizontal square about (0, y, 0).
void add_floor(RenderScene& world, float size, float y, base::Handle material) {
    world.add_quad({-size, y, size}, {size, y, size}, {size, y, -size}, {-size, y, -size},
                   material);
}

// One that glows, green and blue everywhere alike, red from 0 to 1 as x goes from -size to size.
void add_ruler(RenderScene& world, float size, float y) {
    constexpr uint32_t kTexels = 8192;
    std::vector<float> texels;
    for (uint32_t i = 0; i < kTexels; ++i)
        texels.insert(texels.end(), {(float(i) + 0.5f) / kTexels, 1, 1, 1});
    add_floor(world, size, y,
              world.add(glowing(Vec3(1)), {}, {}, world.add_texture(kTexels, 1, texels)));
}

// What the ruler says of a pixel: x, whatever the light has lost.
double read_ruler(const Vec3& color, double size) {
    return (2.0 * double(color.x) / double(color.y) - 1.0) * size;
}

// In the plane z = 0, from the downward vertical toward +x.
Camera looking(const math::Vec3d& position, double angle) {
    Camera camera;
    camera.position = position;
    camera.forward = {float(std::sin(angle)), float(-std::cos(angle)), 0};
    camera.up = {0, 0, -1};
    camera.vertical_fov = 0.02f;
    return camera;
}

Frame frame_of(uint32_t size, uint32_t depth) {
    Frame frame = test::float_frame(size, size);
    frame.bounces.max_depth = depth;
    return frame;
}

// The middle of a small picture.
Vec3 see(RenderScene& world, const Camera& camera, uint32_t depth) {
    return take_picture(world, camera, frame_of(5, depth)).at(2, 2);
}

// Of unpolarised light that comes at an angle.
double fresnel(double angle, double from, double to) {
    const double sine = from / to * std::sin(angle);
    if (sine >= 1) return 1;
    const double c = std::cos(angle), t = std::sqrt(1 - sine * sine);
    const double s = (from * c - to * t) / (from * c + to * t);
    const double p = (to * c - from * t) / (to * c + from * t);
    return (s * s + p * p) / 2;
}

//     eye
//      \  /
//   ----\/---- mirror     the ruler is above the eye
TEST(Mirror, ShowsWhatIsThereByTheLawOfReflection) {
    for (const double angle : {0.0, 30.0, 60.0, 80.0}) {
        RenderScene world;
        add_floor(world, 50, 0, world.add(mirror(1)));
        add_ruler(world, 40, 2);
        const Vec3 seen = see(world, looking({0, 1, 0}, angle * kDegree), 1);
        EXPECT_NEAR(read_ruler(seen, 40), 3 * std::tan(angle * kDegree), 0.02) << angle;
        EXPECT_NEAR(seen.y, 1, 1e-6) << angle;
    }
}

TEST(Mirror, ReflectsMoreAtAGlance) {
    for (const double angle : {0.0, 30.0, 60.0, 80.0}) {
        RenderScene world;
        add_floor(world, 50, 0, world.add(mirror(0.5f, {1, 0.5f, 0})));
        add_floor(world, 50, 2, world.add(glowing(Vec3(3))));
        const Vec3 seen = see(world, looking({0, 1, 0}, angle * kDegree), 1);
        const double more = std::pow(1 - std::cos(angle * kDegree), 5);
        for (int k = 0; k < 3; ++k) {
            const double head_on = 0.5 * (1 - 0.5 * k);
            EXPECT_NEAR(seen[k], 3 * (head_on + (1 - head_on) * more), 1e-5) << angle;
        }
    }
}

TEST(Mirror, LeavesTheRestToTheSurface) {
    RenderScene world;
    world.scene.environment.ambient = Vec3(0.5f);
    scene::Material material = mirror(0.25f);
    material.base_color = {0.8f, 0.4f, 0, 1};
    add_floor(world, 50, 0, world.add(material));
    const Vec3 seen = see(world, looking({0, 1, 0}, 0), 1);
    EXPECT_NEAR(seen.x, 0.75 * 0.8 * 0.5, 1e-6);
    EXPECT_NEAR(seen.y, 0.75 * 0.4 * 0.5, 1e-6);
    EXPECT_EQ(see(world, looking({0, 1, 0}, 0), 0), Vec3(0.4f, 0.2f, 0)) << "matt without bounces";
}

// Each sends back nine tenths and glows itself.
TEST(Mirror, TwoThatFaceEachOtherEndAtTheGreatestDepth) {
    RenderScene world;
    scene::Material material = mirror(0.9f);
    material.emissive = Vec3(0.01f);
    const base::Handle handle = world.add(material);
    add_floor(world, 50, 0, handle);
    add_floor(world, 50, 2, handle);
    world.scene.environment.ambient = Vec3(0.3f);
    for (const uint32_t depth : {1u, 2u, 4u, 16u}) {
        const Picture picture = take_picture(world, looking({0, 1, 0}, 0), frame_of(5, depth));
        double expected = 0.3 * std::pow(0.9, depth + 1); // what is not traced
        for (uint32_t i = 0; i <= depth; ++i) expected += 0.01 * std::pow(0.9, i);
        EXPECT_NEAR(picture.at(2, 2).x, expected, 1e-5) << depth;
        EXPECT_EQ(picture.stats.rays_bounced, 25u * depth);
    }
}

TEST(Mirror, PathsThatHardlyCountEnd) {
    RenderScene world;
    add_floor(world, 50, 0, world.add(mirror(0.1f)));
    add_floor(world, 50, 2, world.add(glowing(Vec3(1))));
    Frame frame = frame_of(5, 4);
    frame.bounces.least_importance = 0.09f;
    EXPECT_EQ(take_picture(world, looking({0, 1, 0}, 0), frame).stats.rays_bounced, 25u);
    frame.exposure = 0.5f; // it shows half as much
    const Picture picture = take_picture(world, looking({0, 1, 0}, 0), frame);
    EXPECT_EQ(picture.stats.rays_bounced, 0u);
    EXPECT_EQ(picture.at(2, 2), Vec3(0));
}

// Bumps and smooth normals may not send light into the surface.
TEST(Mirror, ANormalMapNeverLooksThroughTheMirror) {
    RenderScene world;
    const base::Handle map = world.add_texture(1, 1, {0.98f, 0.5f, 0.55f, 1});
    add_floor(world, 50, 0, world.add(mirror(1), {}, map));
    add_floor(world, 500, -1, world.add(glowing(Vec3(1)))); // beneath
    for (const double angle : {-80.0, -45.0, 0.0, 45.0, 80.0})
        EXPECT_EQ(see(world, looking({0, 1, 0}, angle * kDegree), 2), Vec3(0)) << angle;
}

//      eye
//        \         air
//   ------\-------
//          |       glass
//   _______|______ ruler
TEST(Glass, BendsLightBySnellsLaw) {
    for (const double angle : {0.0, 20.0, 60.0, 85.0})
        for (const double index : {1.0, 1.33, 1.5, 2.4}) {
            RenderScene world;
            add_box(world, {-30, -5, -30}, {30, 0, 30}, world.add(glass(float(index))));
            add_ruler(world, 26, -1);
            const Vec3 seen = see(world, looking({0, 1, 0}, angle * kDegree), 2);
            const double bent = std::asin(std::sin(angle * kDegree) / index);
            EXPECT_NEAR(read_ruler(seen, 26), std::tan(angle * kDegree) + std::tan(bent), 0.01)
                << angle << " " << index;
            EXPECT_NEAR(seen.y, 1 - fresnel(angle * kDegree, 1, index), 1e-5)
                << angle << " " << index;
        }
}

TEST(Glass, MirrorsByFresnelsEquations) {
    for (const double angle : {0.0, 30.0, 56.3, 60.0, 85.0}) {
        RenderScene world;
        add_box(world, {-90, -5, -90}, {90, 0, 90}, world.add(glass()));
        add_floor(world, 90, 2, world.add(glowing(Vec3(1))));
        const Vec3 seen = see(world, looking({0, 1, 0}, angle * kDegree), 1);
        EXPECT_NEAR(seen.x, fresnel(angle * kDegree, 1, 1.5), 1e-5) << angle;
    }
}

// From within, up: what is not bent out is all mirrored down.
TEST(Glass, ReflectsTotallyBeyondTheCriticalAngle) {
    for (const double angle : {0.0, 20.0, 41.0, 43.0, 60.0, 80.0}) {
        RenderScene world;
        add_box(world, {-90, -9, -90}, {90, 0, 90}, world.add(glass()));
        add_ruler(world, 80, 1);
        add_floor(world, 80, -2, world.add(glowing({0, 0, 1})));
        const Vec3 seen = see(world, looking({0, -1, 0}, (180 - angle) * kDegree), 1);
        const double back = fresnel(angle * kDegree, 1.5, 1);
        EXPECT_NEAR(seen.y, 1 - back, 1e-4) << angle;
        EXPECT_NEAR(seen.z, 1, 1e-5) << angle << ": both are as bright";
        if (back == 1) continue;
        const double out = std::asin(1.5 * std::sin(angle * kDegree));
        EXPECT_NEAR(read_ruler(seen, 80), std::tan(angle * kDegree) + std::tan(out), 0.03) << angle;
    }
}

TEST(Glass, SwallowsLightByBeersLaw) {
    for (const double angle : {0.0, 60.0}) {
        RenderScene world;
        scene::Material material = glass();
        // Half of the red, a quarter of the green, and none of the blue is lost in two metres.
        material.absorption = {float(std::log(2.0) / 2), float(std::log(4.0 / 3) / 2), 0};
        add_box(world, {-30, -3, -30}, {30, 0, 30}, world.add(material));
        add_floor(world, 30, -4, world.add(glowing(Vec3(1))));
        const Vec3 seen = see(world, looking({0, 1, 0}, angle * kDegree), 2);
        const double bent = std::asin(std::sin(angle * kDegree) / 1.5);
        const double metres = 3 / std::cos(bent);
        const double through = std::pow(1 - fresnel(angle * kDegree, 1, 1.5), 2);
        EXPECT_NEAR(seen.x, through * std::pow(0.5, metres / 2), 1e-5);
        EXPECT_NEAR(seen.y, through * std::pow(0.75, metres / 2), 1e-5);
        EXPECT_NEAR(seen.z, through, 1e-5);
    }
}

TEST(Glass, SwallowsWhatTheEyeWithinSees) {
    RenderScene world;
    scene::Material material = glass();
    material.absorption = Vec3(float(std::log(2.0)));
    add_box(world, {-30, -9, -30}, {30, 9, 30}, world.add(material));
    add_floor(world, 30, -3, world.add(glowing(Vec3(1))));
    EXPECT_NEAR(see(world, looking({0, 0, 0}, 0), 2).x, 0.125, 1e-6);
    EXPECT_NEAR(see(world, looking({0, 0, 0}, 0), 0).x, 1, 1e-6) << "not without bounces";
}

// The inner one is like the outer, or denser.
TEST(Glass, StandsInGlass) {
    for (const double inner : {1.5, 2.0}) {
        RenderScene world;
        add_box(world, {-30, -6, -30}, {30, 0, 30}, world.add(glass()));
        add_box(world, {-20, -4, -20}, {20, -2, 20}, world.add(glass(float(inner))));
        add_ruler(world, 20, -7);
        const double angle = 60 * kDegree;
        const Vec3 seen = see(world, looking({0, 1, 0}, angle), 4);
        const double in = std::asin(std::sin(angle) / 1.5);
        const double deeper = std::asin(std::sin(angle) / inner);
        const double through = (1 - fresnel(angle, 1, 1.5)) * (1 - fresnel(in, 1.5, inner));
        EXPECT_NEAR(read_ruler(seen, 20),
                    2 * std::tan(angle) + 4 * std::tan(in) + 2 * std::tan(deeper), 0.02);
        EXPECT_NEAR(seen.y, through * through, 1e-4);
    }
}

TEST(Glass, TintsByItsColourAndLeavesTheRestMatt) {
    RenderScene world;
    world.scene.environment.ambient = Vec3(0.5f);
    scene::Material material = pane();
    material.transmission = 0.75f;
    material.base_color = {1, 0.5f, 0.25f, 1};
    add_floor(world, 30, 0, world.add(material));
    add_floor(world, 30, -1, world.add(glowing(Vec3(2)))); // and black: 2 is all
    const Vec3 seen = see(world, looking({0, 1, 0}, 0), 1);
    const double r = 0.04, mirrored = 2 * r / (1 + r);
    for (int k = 0; k < 3; ++k) {
        const double color = std::pow(0.5, k);
        const double expected = (1 - mirrored) * color * (0.75 * 2 + 0.25 * 0.5);
        EXPECT_NEAR(seen[k], expected, 1e-5) << "the sky that is mirrored is black";
    }
}

TEST(Pane, LetsLightGoStraightOn) {
    for (const double angle : {0.0, 60.0, 80.0}) {
        RenderScene world;
        add_floor(world, 90, 0, world.add(pane()));
        add_ruler(world, 40, -1);
        const Vec3 seen = see(world, looking({0, 1, 0}, angle * kDegree), 1);
        const double r = fresnel(angle * kDegree, 1, 1.5);
        EXPECT_NEAR(read_ruler(seen, 40), 2 * std::tan(angle * kDegree), 0.02);
        EXPECT_NEAR(seen.y, 1 - 2 * r / (1 + r), 1e-5);
    }
}

TEST(Pane, LetsLampsShineThrough) {
    const auto lit = [](float transmission) {
        RenderScene world;
        scene::Material white;
        white.double_sided = true;
        add_floor(world, 10, 0, world.add(white));
        scene::Material material = pane();
        material.transmission = transmission;
        add_floor(world, 10, 3, world.add(material));
        scene::Light lamp;
        lamp.position = {0, 4, 0};
        lamp.intensity = Vec3(100);
        world.add(lamp);
        return see(world, looking({0, 1, 0}, 0), 0).x;
    };
    EXPECT_GT(lit(1), 0);
    EXPECT_GT(lit(0.6f), 0);
    EXPECT_EQ(lit(0.5f), 0) << "more is swallowed than not: it casts a shadow";
    EXPECT_EQ(lit(0), 0);
}

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
} // namespace peregrine::render
