// Light that fog scatters, beside integrals along rays.
#include "airlight_truth.h"
#include "render_scene.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using math::Vec3d;
using scene::Falloff;
using test::airlight_along;
using test::Picture;
using test::RenderScene;
using test::take_picture;

const scene::Fog kDeep{0.1f, 500, 400};
const scene::Fog kLayer{0.15f, 3, 1};

scene::Light point_at(const Vec3d& position) {
    scene::Light light;
    light.position = position;
    light.intensity = {20, 10, 5};
    light.radius = 8;
    light.fog_scatter = 0.5f;
    return light;
}

scene::Light spot_at(const Vec3d& position, const Vec3& direction, double outer, double inner) {
    scene::Light light = point_at(position);
    light.type = scene::LightType::spot;
    light.direction = glm::normalize(direction);
    light.cone_outer_cos = float(std::cos(outer));
    light.cone_inner_cos = float(std::cos(inner));
    return light;
}

// A black wall twelve metres ahead of the origin, which is what most eyes look at.
struct AirScene : RenderScene {
    explicit AirScene(const scene::Fog& fog, uint32_t threads = 1, base::Isa isa = base::Isa::best)
        : RenderScene(threads, isa) {
        scene.fog = fog;
        scene::Material black = test::glowing(Vec3(0));
        add_quad({-90, -90, -12}, {90, -90, -12}, {90, 90, -12}, {-90, 90, -12}, add(black));
    }
};

constexpr uint32_t kSide = 21; // so that a ray goes straight ahead

Camera looking(const Vec3d& from, const Vec3& forward) {
    Camera camera;
    camera.position = from;
    camera.forward = forward;
    camera.up = std::fabs(forward.y) > 0.9f * glm::length(forward) ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
    camera.vertical_fov = 1.3f;
    return camera;
}

// Pixels near 1 / 1024 of the radius are another matter.
void expect_integral(
    const Picture& picture, const scene::Fog& fog, const scene::Light& light, const Camera& camera,
    const char* what, const test::Sees& sees = [](const Vec3d&) { return true; }) {
    const Pinhole pinhole(camera, kSide, kSide);
    std::vector<double> expected;
    double most = 0;
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
        const Vec3d ray(pinhole.direction(i % kSide, i / kSide));
        const double ahead = ray.z < 0 ? (-12 - camera.position.z) / ray.z : 1e6;
        expected.push_back(airlight_along(fog, light, camera.position, glm::normalize(ray),
                                          ahead * glm::length(ray), sees));
        most = std::max(most, expected.back());
    }
    EXPECT_GT(most, 1e-4) << what;
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
        const Vec3 found = picture.at(i % kSide, i / kSide);
        const double bright = double(light.intensity.x) * expected[i];
        ASSERT_NEAR(double(found.x), bright,
                    0.01 * bright + 5e-4 * double(light.intensity.x) * std::min(most, 1.0))
            << what << ", pixel " << i % kSide << " " << i / kSide;
        ASSERT_NEAR(double(found.x), 2 * double(found.y), 1e-5 * bright);
    }
}

void expect_law(const scene::Fog& fog, const scene::Light& light, const Camera& camera,
                const char* what) {
    AirScene world(fog);
    world.add(light);
    expect_integral(take_picture(world, camera, kSide, kSide), fog, light, camera, what);
}

const Camera kAhead = looking({0, 0, 0}, {0, 0, -1});

TEST(Airlight, OfPointsIsTheIntegral) {
    expect_law(kDeep, point_at({0.3, 0.4, -6}), kAhead, "from outside");
    expect_law(kDeep, point_at({0.3, 1.4, -4}), kAhead, "from within");
    expect_law(kDeep, point_at({0.3, 0.2, 3}), kAhead, "behind the eye");
    expect_law(kDeep, point_at({1.5, -0.3, -11.9}), kAhead, "at the wall");
    expect_law(kLayer, point_at({0.3, 2, -5}), kAhead, "in a layer");
    expect_law(kLayer, point_at({0.3, 5, -5}), looking({0, 6, 0}, {0, -0.7f, -1}), "above it");
    expect_law(kLayer, point_at({0.3, 4, -5}), looking({0, 0, 0}, {0, 1, -0.2f}), "from below");
    expect_law({0.4f, 2, 2}, point_at({0.1, 3, -4}), kAhead, "of a layer with an edge");
}

TEST(Airlight, OfAllFalloffs) {
    for (uint32_t law = 0; law < scene::kFalloffCount; ++law)
        for (const Vec3d& place : {Vec3d(0.4, 0.7, -9), Vec3d(0.2, 1, -3)}) {
            scene::Light light = point_at(place);
            light.falloff = Falloff(law);
            expect_law(kDeep, light, kAhead, "a point");
            light = spot_at(place, {0.3f, -1, 0.1f}, 0.7, 0.3);
            light.falloff = Falloff(law);
            expect_law(kDeep, light, kAhead, "a spot");
        }
}

//        \ | /      from the side, from within, along its side, by its tip, from behind it
//   eye   \|/  eye
TEST(Airlight, OfSpotsIsTheIntegral) {
    const auto down = [](double outer, double inner) {
        return spot_at({0, 3, -6}, {0, -1, 0}, outer, inner);
    };
    expect_law(kDeep, down(0.5, 0.35), kAhead, "from the side");
    expect_law(kDeep, down(0.5, 0.5), kAhead, "with a sharp rim");
    expect_law(kDeep, down(0.5, 0.0), kAhead, "with a soft rim");
    expect_law(kLayer, down(0.5, 0.3), kAhead, "in a layer");
    expect_law(kDeep, down(0.05, 0.03), kAhead, "a thin one");
    expect_law(kDeep, down(1.5707963, 1.0), kAhead, "a hemisphere");
    expect_law(kDeep, down(2.5, 2.0), kAhead, "nearly all around");
    expect_law(kDeep, down(2.0, 1.2), looking({0.2f, 3.1f, 0}, {0, 0, -1}),
               "more than a hemisphere");
    expect_law(kDeep, spot_at({0, 0.2, -9}, {0, 0, 1}, 0.6, 0.4), kAhead, "from within");
    expect_law(kDeep, spot_at({0, 0.2, 2}, {0, 0, -1}, 0.4, 0.2), kAhead, "from behind the lamp");
    expect_law(kDeep, spot_at({0.2, 0.3, -5}, {0, 0, -1}, 0.4, 0.2), kAhead, "away from the eye");
    expect_law(kDeep, down(0.5, 0.3), looking({0, 6, -6.3}, {0, -1, 0}), "down its axis");
    expect_law(kDeep, down(0.5, 0.3), looking({0, -4, -6.3}, {0, 1, 0}), "up its axis");
    expect_law(kDeep, spot_at({0, 5, -6}, {0, -1, 0}, 0.7853981634, 0.6),
               looking({0.03f, -1.05f, 0}, {0, 1, -1}), "along its side and by its tip");
}

// Where the mirror image of the cone is there is no light.
TEST(Airlight, OfASpotIsOnlyAhead) {
    AirScene world(kDeep);
    world.add(spot_at({0, 0, -6}, {0, -1, 0}, 0.6, 0.4));
    const Camera camera = looking({0, 3, 0}, {0, 0, -1});
    const Picture picture = take_picture(world, camera, kSide, kSide);
    for (uint32_t x = 0; x < kSide; ++x) EXPECT_EQ(picture.at(x, kSide / 2), Vec3(0));
    EXPECT_GT(picture.at(kSide / 2, kSide - 1).x, 0.0f);
}

//    lamp above a ceiling with a hole: the wall of the beam is that of the hole
TEST(Airlight, HasShadows) {
    const scene::Light light = spot_at({0, 4, -6}, {0, -1, 0}, 0.7, 0.4);
    AirScene world(kDeep);
    const base::Handle black = world.add(test::glowing(Vec3(0)));
    world.add_quad({0.3f, 2, -16}, {9, 2, -16}, {9, 2, 4}, {0.3f, 2, 4}, black);
    world.add(light);
    Frame frame = test::float_frame(kSide, kSide);
    const test::Sees sees = [&](const Vec3d& place) {
        if (place.y >= 2) return true;
        const double part = (light.position.y - 2) / (light.position.y - place.y);
        const Vec3d at = light.position + part * (place - light.position);
        return !(at.x > 0.3 && at.x < 9);
    };
    const Camera camera = looking({0, 0.3, 0}, {0, -0.1f, -1}); // below it all
    frame.airlight_pieces = 32;
    const Picture picture = take_picture(world, camera, frame);
    EXPECT_GT(picture.stats.rays_shadow, 5000u);
    const Pinhole pinhole(camera, kSide, kSide);
    frame.airlight_block = 2;
    const Picture blocks = take_picture(world, camera, frame);
    EXPECT_LT(blocks.stats.rays_shadow, picture.stats.rays_shadow);
    double sum = 0, off = 0, blocks_off = 0;
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
        const Vec3d ray(pinhole.direction(i % kSide, i / kSide));
        double ahead = ray.z < 0 ? -12 / ray.z : 1e6;
        if (ray.y > 0) {
            const Vec3d above = camera.position + ray * (1.7 / ray.y);
            if (above.x > 0.3 && above.z > -12) ahead = std::min(ahead, 1.7 / ray.y);
        }
        const double expected = double(light.intensity.x)
                                * airlight_along(kDeep, light, camera.position, glm::normalize(ray),
                                                 ahead * glm::length(ray), sees);
        sum += expected;
        off += std::fabs(double(picture.at(i % kSide, i / kSide).x) - expected);
        blocks_off += std::fabs(double(blocks.at(i % kSide, i / kSide).x) - expected);
    }
    EXPECT_LT(off, 0.01 * sum);
    EXPECT_LT(blocks_off, 0.02 * sum);

    frame.airlight_pieces = 0;
    EXPECT_EQ(take_picture(world, camera, frame).stats.rays_shadow, 0u);
    frame.airlight_pieces = 32;
    frame.shadows = false;
    EXPECT_EQ(take_picture(world, camera, frame).stats.rays_shadow, 0u);
}

// A lamp that sees all is as bright in pieces.
TEST(Airlight, InPiecesIsWhatItIs) {
    AirScene world(kDeep);
    world.add(spot_at({0, 3, -6}, {0, -1, 0}, 0.5, 0.3));
    const base::Handle black = world.add(test::glowing(Vec3(0)));
    world.add_triangle({50, 50, 0}, {51, 50, 0}, {50, 51, 0}, black);
    Frame frame = test::float_frame(kSide, kSide);
    const Picture whole = take_picture(world, kAhead, frame);
    frame.airlight_pieces = 12;
    EXPECT_EQ(take_picture(world, kAhead, frame).pixels, whole.pixels);
}

//   eye | mirror at -4;  the lamp is behind the eye
TEST(Airlight, IsSeenInMirrors) {
    RenderScene world;
    scene::Material mirror;
    mirror.base_color = {0, 0, 0, 1};
    mirror.reflectivity = 1;
    mirror.reflection_color = Vec3(1);
    mirror.double_sided = true;
    world.add_quad({-9, -9, -4}, {9, -9, -4}, {9, 9, -4}, {-9, 9, -4}, world.add(mirror));
    world.scene.fog = kDeep;
    const scene::Light light = spot_at({0.5, 3, 3}, {0, -1, 0}, 0.5, 0.3);
    world.add(light);
    Frame frame = test::float_frame(1, 1);
    frame.bounces.max_depth = 2;
    const float found = take_picture(world, kAhead, frame).at(0, 0).x;
    const double seen = airlight_along(kDeep, light, {0, 0, -4}, {0, 0, 1}, 1e6)
                        * double(std::exp(-0.4f) * light.intensity.x);
    const double before =
        airlight_along(kDeep, light, {0, 0, 0}, {0, 0, -1}, 4) * double(light.intensity.x);
    EXPECT_NEAR(double(found), seen + before, 0.01 * (seen + before));
}

TEST(Airlight, NeedsFogAndALampThatItScatters) {
    const auto features = [](float density, float scatter) {
        AirScene world(scene::Fog{density, 9, 5});
        scene::Light light = point_at({0, 0, -5});
        light.fog_scatter = scatter;
        world.add(light);
        take_picture(world, kAhead, 3, 3);
        const scene::SnapshotStore::Pin pin(world.scene.snapshots);
        return pin.get()->features & uint32_t(scene::kAirlight);
    };
    EXPECT_EQ(features(0, 0.5f), 0u);
    EXPECT_EQ(features(0.1f, 0), 0u);
    EXPECT_EQ(features(0.1f, 0.5f), uint32_t(scene::kAirlight));
}

TEST(Airlight, OfAnythingIsANumber) {
    for (const float density : {1e-30f, 0.1f, 3e38f})
        for (const float radius : {1e-30f, 1e-4f, 1e6f, 3e38f})
            for (const double place : {0.0, 5.0, 1e12, 1e30}) {
                AirScene world(scene::Fog{density, 1, -1e30});
                scene::Light light = spot_at({0, 0, -place}, {0, 0, -1}, 0.5, 0.3);
                light.radius = radius;
                light.intensity = Vec3(3e38f);
                world.add(light);
                light.type = scene::LightType::point;
                light.falloff = Falloff::schlick_linear;
                world.add(light);
                for (const float value : take_picture(world, kAhead, 9, 9).pixels)
                    ASSERT_TRUE(value >= 0 && value <= 3e20f)
                        << density << " " << radius << " " << place << ": " << value;
            }
}

TEST(Airlight, IsTheSameForAnyThreadsAndInstructionSets) {
    const auto fill = [](AirScene& world) {
        const base::Handle black = world.add(test::glowing(Vec3(0)));
        world.add_quad({0.3f, 1, -16}, {9, 1, -16}, {9, 1, 4}, {0.3f, 1, 4}, black);
        for (uint32_t law = 0; law < scene::kFalloffCount; ++law) {
            scene::Light light = point_at({law - 2.0, 2, -4.0 - law});
            light.falloff = Falloff(law);
            world.add(light);
            light = spot_at(light.position, {0.2f, -1, -0.1f}, law + 0.5, 0.4);
            light.falloff = Falloff(law);
            world.add(light);
        }
    };
    Frame frame = test::float_frame(77, 50);
    frame.approximations.edge_samples = 3;
    frame.airlight_pieces = 9;
    AirScene plain(kLayer, 1, base::Isa::scalar);
    fill(plain);
    const Picture expected = take_picture(plain, kAhead, frame);
    for (const base::Isa isa : {base::Isa::sse4, base::Isa::avx2, base::Isa::avx512}) {
        if (!base::is_available(isa)) continue;
        AirScene world(kLayer, 3, isa);
        fill(world);
        EXPECT_EQ(take_picture(world, kAhead, frame).pixels, expected.pixels);
    }
}

} // namespace
} // namespace peregrine::render
