// Fog beside integrals of its density along rays.
#include "render_scene.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using math::Vec3d;
using test::Picture;
using test::RenderScene;
using test::take_picture;

constexpr Vec3 kFogColor(0.5f, 0.6f, 0.7f), kBackground(2, 1, 0.25f), kWall(3, 0.5f, 1);

scene::Material glowing(const Vec3& color) {
    scene::Material material;
    material.base_color = {0, 0, 0, 1};
    material.emissive = color;
    material.double_sided = true;
    return material;
}

double density_at(const scene::Fog& fog, double height) {
    if (height <= fog.bottom) return double(fog.density);
    if (height >= fog.top) return 0;
    return double(fog.density) * (fog.top - height) / (fog.top - fog.bottom);
}

// By the midpoint rule.
double depth_along(const scene::Fog& fog, const Vec3d& from, const Vec3d& unit, double metres) {
    constexpr int kSteps = 4000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        sum += density_at(fog, from.y + unit.y * metres * (i + 0.5) / kSteps);
    return sum * metres / kSteps;
}

// Of rays that leave the scene: until they are above the layer, or for ever.
double depth_to_infinity(const scene::Fog& fog, const Vec3d& from, const Vec3d& unit) {
    if (unit.y > 0)
        return from.y >= fog.top ? 0 : depth_along(fog, from, unit, (fog.top - from.y) / unit.y);
    return unit.y < 0 || density_at(fog, from.y) > 0 ? 1e9 : 0;
}

//   ________ top        a wall ten metres ahead of the eye, as high as eight metres;
//   ........ bottom     sky above it
struct FogScene : RenderScene {
    explicit FogScene(const scene::Fog& fog, uint32_t threads = 1, base::Isa isa = base::Isa::best)
        : RenderScene(threads, isa) {
        scene.environment.background = kBackground;
        scene.fog = fog;
        scene.fog.color = kFogColor;
        add_quad({-40, -40, -10}, {40, -40, -10}, {40, 8, -10}, {-40, 8, -10}, add(glowing(kWall)));
    }
};

Camera looking(double height, const Vec3& forward) {
    Camera camera;
    camera.position = {0, height, 0};
    camera.forward = forward;
    camera.up = std::fabs(forward.y) > 0.9f ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
    camera.vertical_fov = 1.2f;
    return camera;
}

void expect_law(const scene::Fog& fog, const Camera& camera) {
    constexpr uint32_t kSide = 33; // so that a ray goes straight ahead
    FogScene world(fog);
    const Picture picture = take_picture(world, camera, kSide, kSide);
    const Pinhole pinhole(camera, kSide, kSide);
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) {
            const Vec3d ray(pinhole.direction(x, y));
            const Vec3d unit = glm::normalize(ray);
            const double ahead = ray.z < 0 ? -10 / ray.z : -1;
            const Vec3d place = camera.position + ray * ahead;
            const bool hits = ahead > 0 && place.y < 8 && place.y > -40 && std::fabs(place.x) < 40;
            const double depth =
                hits ? depth_along(fog, camera.position, unit, ahead * glm::length(ray))
                     : depth_to_infinity(fog, camera.position, unit);
            const auto clear = float(std::exp(-depth));
            const Vec3 expected = (hits ? kWall : kBackground) * clear + kFogColor * (1 - clear);
            ASSERT_LT(glm::length(picture.at(x, y) - expected), 2e-3f)
                << "pixel " << x << " " << y << ", eye at " << camera.position.y << ", depth "
                << depth;
        }
}

TEST(Fog, IsTheIntegralOfItsDensity) {
    for (const scene::Fog& fog : {scene::Fog{0.1f, 3, 0}, scene::Fog{0.3f, 2, 1.9},
                                  scene::Fog{0.05f, 6, -5}, scene::Fog{0.2f, 1.5, 1.5}})
        for (const double eye : {-3.0, 0.5, 1.5, 1.95, 2.9, 7.0}) // below, within, on it, above
            for (const Vec3& forward : {Vec3(0, 0, -1), Vec3(0, 0.4f, -1), Vec3(0.3f, -0.6f, -1),
                                        Vec3(0, 1, 0), Vec3(0, -1, 0)})
                expect_law(fog, looking(eye, forward));
}

TEST(Fog, OfHorizontalRaysIsThatOfTheEyesHeight) {
    for (const double eye : {-1.0, 0.0, 0.75, 1.5, 3.0, 4.0}) {
        const scene::Fog fog{0.2f, 3, 0};
        FogScene world(fog);
        const Picture picture = take_picture(world, looking(eye, {0, 0, -1}), 1, 1);
        const auto clear = float(std::exp(-10 * density_at(fog, eye)));
        const Vec3 expected = kWall * clear + kFogColor * (1 - clear);
        EXPECT_LT(glm::length(picture.at(0, 0) - expected), 1e-4f) << eye;
    }
}

TEST(Fog, OutsideOfItIsNone) {
    FogScene clear(scene::Fog{}), below(scene::Fog{0.5f, -20, -30});
    const Camera camera = looking(30, {0, 0.9f, -1});
    EXPECT_EQ(take_picture(clear, camera).pixels, take_picture(below, camera).pixels);
    EXPECT_EQ(scene::features_of(scene::Fog{}), 0u);
    EXPECT_EQ(scene::features_of(scene::Fog{0.1f}), uint32_t(scene::kFog));
}

TEST(Fog, OfAnyDensityIsBounded) {
    for (const float density : {1e-30f, 1e3f, 3e38f})
        for (const double height : {-1e30, 0.0, 1e30}) {
            FogScene world(scene::Fog{density, height, -1e30});
            for (const float value : take_picture(world, looking(0, {0, 0, -1}), 9, 9).pixels)
                ASSERT_TRUE(value >= 0 && value <= 3.0001f) << density << " " << height;
        }
}

//   eye | mirror at -4;  a lamp behind the eye at +6
TEST(Fog, LiesOnTheWayFromAMirror) {
    RenderScene world;
    scene::Material mirror;
    mirror.base_color = {0, 0, 0, 1};
    mirror.reflectivity = 1;
    mirror.reflection_color = Vec3(1);
    mirror.double_sided = true;
    world.add_quad({-9, -9, -4}, {9, -9, -4}, {9, 9, -4}, {-9, 9, -4}, world.add(mirror));
    world.add_quad({-9, -9, 6}, {9, -9, 6}, {9, 9, 6}, {-9, 9, 6}, world.add(glowing(kWall)));
    world.scene.fog = {0.1f, 90, 80, kFogColor};
    Frame frame = test::float_frame(1, 1);
    frame.bounces.max_depth = 3;
    const Picture picture = take_picture(world, looking(0, {0, 0, -1}), frame);
    const float near = std::exp(-0.4f), far = std::exp(-1.0f);
    const Vec3 mirrored = kWall * far + kFogColor * (1 - far);
    const Vec3 expected = mirrored * near + kFogColor * (1 - near);
    EXPECT_LT(glm::length(picture.at(0, 0) - expected), 1e-4f);
}

TEST(Fog, IsTheSameForAnyThreadsAndInstructionSets) {
    const scene::Fog fog{0.1f, 2, 0};
    FogScene plain(fog, 1, base::Isa::scalar);
    Frame frame = test::float_frame(77, 50);
    frame.approximations.edge_samples = 3;
    const Camera camera = looking(1, {0.2f, -0.1f, -1});
    const Picture expected = take_picture(plain, camera, frame);
    for (const base::Isa isa : {base::Isa::sse4, base::Isa::avx2, base::Isa::avx512}) {
        if (!base::is_available(isa)) continue;
        FogScene world(fog, 3, isa);
        EXPECT_EQ(take_picture(world, camera, frame).pixels, expected.pixels);
    }
}

} // namespace
} // namespace peregrine::render
