// Lights that are spheres: how much of them is seen past an edge.
#include "render_scene.h"
#include "shade/light/sphere_points.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using test::Picture;
using test::RenderScene;
using test::take_picture;

constexpr double kPi = std::numbers::pi;

// The part of a disc of radius 1 on one side of a line at this distance from its centre.
double segment(double distance) {
    const double d = std::clamp(distance, -1.0, 1.0);
    return (std::acos(d) - d * std::sqrt(1 - d * d)) / kPi;
}

//      * lamp at (0, 8, 0)
//   ______|         half a plane at y = 4, x < 0
//   . . . . . . .   a white floor, seen from above
struct EdgeWorld : RenderScene {
    explicit EdgeWorld(float source_radius, uint32_t samples, double place = 0, bool edge = true) {
        scene::Material white;
        white.double_sided = true;
        const base::Handle floor = add(white);
        add_quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}, floor);
        if (edge) add_quad({-9, 4, 9}, {0, 4, 9}, {0, 4, -9}, {-9, 4, -9}, floor);
        scene::Light lamp;
        lamp.position = {place, 8 + place, 0};
        lamp.radius = std::numeric_limits<float>::infinity();
        lamp.falloff = scene::Falloff::inverse_square;
        lamp.intensity = Vec3(100);
        lamp.source_radius = source_radius;
        lamp.shadow_samples = samples;
        add(lamp);
    }

    // Of a row of the floor, from below the edge.
    Picture row() {
        Camera camera;
        camera.position = {0, 3.5, 0};
        camera.forward = {0, -1, 0};
        camera.up = {0, 0, -1};
        camera.vertical_fov = 0.001f;
        return take_picture(*this, camera, 512, 1);
    }
};

TEST(SoftShadows, ShowThePartOfTheSphereThatIsSeen) {
    EdgeWorld soft(0.4f, 256), open(0, 1, 0, false);
    const Picture with = soft.row(), without = open.row();
    double largest = 0;
    uint32_t between = 0;
    for (uint32_t i = 0; i < with.width; ++i) {
        const double width = 3.5 * std::tan(0.0005) * 512;
        const double x = ((i + 0.5) / 256 - 1) * width;
        const double seen = double(with.at(i, 0).x) / double(without.at(i, 0).x);
        const double expected = 1 - segment(x / 0.4);
        largest = std::max(largest, std::fabs(seen - expected));
        between += expected > 0.02 && expected < 0.98;
    }
    EXPECT_GT(between, 100u);
    EXPECT_LT(largest, 0.03);
}

TEST(SoftShadows, ASmallerSphereIsSharper) {
    EdgeWorld wide(0.4f, 64), narrow(0.1f, 64), point(0, 64);
    const auto partial = [](const Picture& picture) {
        uint32_t count = 0;
        for (uint32_t i = 1; i < picture.width; ++i)
            count += picture.at(i, 0).x != picture.at(i - 1, 0).x;
        return count;
    };
    const uint32_t a = partial(wide.row()), b = partial(narrow.row()), c = partial(point.row());
    EXPECT_GT(a, b);
    EXPECT_GT(wide.row().stats.rays_shadow, narrow.row().stats.rays_shadow);
    EXPECT_GE(b, c);
    EXPECT_EQ(point.row().stats.rays_shadow, 512u);
}

// Where no penumbra is near.
TEST(SoftShadows, CostFewRaysInTheOpen) {
    EdgeWorld open(0.4f, 256, 0, false);
    const Picture picture = open.row();
    EXPECT_EQ(picture.stats.rays_shadow, 512u + 6u * 512u / 4);
    EdgeWorld sharp(0, 1, 0, false);
    EXPECT_EQ(picture.pixels, sharp.row().pixels);
}

TEST(SoftShadows, OddSpheres) {
    for (const float radius : {1e-30f, 1e-3f, 100.0f, 1e30f})
        for (const double place : {0.0, 1e3, 1e9}) {
            EdgeWorld world(radius, 4, place);
            const Picture picture = world.row();
            for (const float value : picture.pixels)
                ASSERT_TRUE(value >= 0 && value <= 1000) << radius << " " << place;
        }
}

TEST(SpherePoints, FillTheDiscFromEverySide) {
    const auto points = shade::sphere_points();
    for (const Vec3& point : points) ASSERT_LE(glm::length(point), 1 + 1e-6f);
    for (const Vec3& toward : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 2, 3)}) {
        const Vec3 axis = glm::normalize(toward);
        double square = 0;
        Vec3 mean(0);
        for (const Vec3& point : points) {
            const Vec3 across = point - axis * glm::dot(axis, point);
            mean += across;
            square += double(glm::dot(across, across));
        }
        EXPECT_LT(glm::length(mean), 1e-4f);
        EXPECT_NEAR(square / double(points.size()), 0.5, 0.03); // of an even disc
    }
}

} // namespace
} // namespace peregrine::render
