// Ambient occlusion: how much of the light from all around arrives.
#include "render_scene.h"
#include "shade/occlusion/open_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using math::Vec3d;
using test::Picture;
using test::RenderScene;
using test::take_picture;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kWide = 4000;
constexpr double kError = 0.02; // of 256 rays

// White things under an ambient light of 1: a picture shows how open they are.
struct WhiteWorld : RenderScene {
    base::Handle white;
    std::vector<std::array<Vec3, 3>> triangles;

    explicit WhiteWorld(uint32_t threads = 1, base::Isa isa = base::Isa::best)
        : RenderScene(threads, isa) {
        scene.environment.ambient = Vec3(1);
        scene::Material material;
        material.double_sided = true;
        white = add(material);
    }
    void add_square(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        add_quad(a, b, c, d, white);
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
    }
    void add_floor() {
        add_square({-kWide, 0, kWide}, {kWide, 0, kWide}, {kWide, 0, -kWide}, {-kWide, 0, -kWide});
    }
    // At x, facing either way.
    void add_wall(float x, float height) {
        add_square({x, 0, kWide}, {x, 0, -kWide}, {x, height, -kWide}, {x, height, kWide});
    }
    void add_ceiling(float y) {
        add_square({-kWide, y, kWide}, {kWide, y, kWide}, {kWide, y, -kWide}, {-kWide, y, -kWide});
    }
};

Occlusion occlusion_of(float range, uint32_t samples = 256, uint32_t block = 1) {
    return {range, samples, block, 0.13f, 0.3f, 0.1f};
}

Picture take(WhiteWorld& world, const Camera& camera, const Occlusion& occlusion, uint32_t width,
             uint32_t height) {
    Frame frame = test::float_frame(width, height);
    frame.occlusion = occlusion;
    return take_picture(world, camera, frame);
}

// Of the floor at a place, seen from a little above it.
float openness_at(WhiteWorld& world, const Vec3d& place, const Occlusion& occlusion) {
    Camera camera;
    camera.position = place + Vec3d(0, 1e-2, 0);
    camera.forward = {0, -1, 0};
    camera.up = {0, 0, -1};
    camera.vertical_fov = 1e-4f;
    return take(world, camera, occlusion, 1, 1).at(0, 0).x;
}

// The mean error of what half planes cut off the disc below the rays.
double mean_error(const shade::OpenRays& rays) {
    constexpr int kTurns = 200, kOffsets = 37;
    double sum = 0;
    for (int i = 0; i < kTurns; ++i)
        for (int j = 0; j < kOffsets; ++j) {
            const double angle = 2 * 3.14159265358979 * i / kTurns, d = 0.05 * (j - 18);
            const double part = (std::acos(d) - d * std::sqrt(1 - d * d)) / 3.14159265358979;
            int count = 0;
            for (const shade::OpenRay& ray : rays.all())
                count += ray.direction.x * std::cos(angle) + ray.direction.y * std::sin(angle) > d;
            sum += std::fabs(count / double(rays.all().size()) - part);
        }
    return sum / (kTurns * kOffsets);
}

// Rays of all lengths keep places for these, which makes them less even on the disc.
TEST(Occlusion, EndlessRaysAreEvener) {
    for (const auto& [count, error] : {std::pair{16u, 0.04}, {64u, 0.012}, {256u, 0.004}}) {
        const double endless = mean_error(shade::OpenRays(count, false));
        EXPECT_LT(endless, error) << count;
        EXPECT_LT(endless, 0.8 * mean_error(shade::OpenRays(count, true))) << count;
    }
}

TEST(Occlusion, AnOpenPlaneGetsAllOfIt) {
    WhiteWorld world;
    world.add_floor();
    for (const float range : {0.1f, 10.0f, kInfinity})
        EXPECT_EQ(openness_at(world, {3, 0, 4}, occlusion_of(range)), 1.0f);
}

//         |
//   wall  |        x: how far away
//   ______|__x____ floor
TEST(Occlusion, ACornerGetsHalfOfIt) {
    WhiteWorld world;
    world.add_floor();
    world.add_wall(0, kWide);
    for (const double x : {0.1, 1.0, 5.0})
        EXPECT_NEAR(openness_at(world, {x, 0, 0}, occlusion_of(kInfinity)), 0.5, kError);
}

// What an infinitely long wall of a height hides: (1 - cosine of the angle to its top) / 2.
TEST(Occlusion, AWallHidesWhatItCovers) {
    WhiteWorld world;
    world.add_floor();
    world.add_wall(0, 2);
    for (const double x : {0.2, 0.5, 1.0, 2.0, 4.0, 20.0}) {
        const double hidden = 0.5 * (1 - x / std::sqrt(x * x + 4));
        EXPECT_NEAR(openness_at(world, {x, 0, 0}, occlusion_of(kInfinity)), 1 - hidden, kError);
        EXPECT_NEAR(openness_at(world, {-x, 0, 0}, occlusion_of(kInfinity)), 1 - hidden, kError);
    }
}

TEST(Occlusion, AClosedBoxGetsNothing) {
    WhiteWorld world;
    const auto at = [](int i) {
        return Vec3(i & 1 ? 1.0f : -1.0f, i & 2 ? 2.0f : 0.0f, i & 4 ? 1.0f : -1.0f);
    };
    for (const std::array<int, 4>& side : {std::array{0, 1, 5, 4},
                                           {2, 3, 7, 6},
                                           {0, 2, 6, 4},
                                           {1, 3, 7, 5},
                                           {0, 1, 3, 2},
                                           {4, 5, 7, 6}})
        world.add_square(at(side[0]), at(side[1]), at(side[2]), at(side[3]));
    for (const Vec3d& place : {Vec3d(0.1, 0, 0.2), Vec3d(0.99, 0, -0.99), Vec3d(-0.5, 0, 0.7)})
        EXPECT_EQ(openness_at(world, place, occlusion_of(1e4f)), 0.0f);
}

// Below a ceiling at a part a of the range, rays whose lengths are evenly distributed hide
// (1 - a)^2 of the light.
TEST(Occlusion, FadesWithTheDistanceAndEndsWithTheRange) {
    WhiteWorld world;
    world.add_floor();
    world.add_ceiling(3);
    EXPECT_EQ(openness_at(world, {}, occlusion_of(2.99f)), 1.0f);
    for (const float range : {3.5f, 4.0f, 6.0f, 12.0f, 100.0f}) {
        const double a = 3 / double(range);
        EXPECT_NEAR(openness_at(world, {}, occlusion_of(range)), 1 - (1 - a) * (1 - a), kError);
        EXPECT_NEAR(openness_at(world, {}, occlusion_of(range, 16)), 1 - (1 - a) * (1 - a), 0.08);
    }
}

bool hits(const Vec3d& from, const Vec3d& direction, double length,
          const std::array<Vec3, 3>& triangle) {
    const Vec3d a(triangle[0]), b = Vec3d(triangle[1]) - a, c = Vec3d(triangle[2]) - a;
    const Vec3d p = glm::cross(direction, c);
    const double determinant = glm::dot(b, p);
    if (determinant == 0) return false;
    const Vec3d s = from - a, q = glm::cross(s, b);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
    const double t = glm::dot(c, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 1e-3 && t < length;
}

// Things fly over a floor; each place asks every triangle.
TEST(Occlusion, IsWhatBruteForceFinds) {
    WhiteWorld world;
    world.add_floor();
    std::mt19937 random(7);
    const auto number = [&](float from, float to) {
        return from + (to - from) * (float(random() >> 8) / 16777216.0f);
    };
    for (int i = 0; i < 40; ++i) {
        const auto corner = [&](const Vec3& middle) {
            return middle + Vec3(number(-1, 1), number(-0.4f, 0.4f), number(-1, 1));
        };
        const Vec3 middle(number(-4, 4), number(0.5f, 3), number(-4, 4));
        const Vec3 a = corner(middle), b = corner(middle), c = corner(middle);
        world.add_triangle(a, b, c, world.white);
        world.triangles.push_back({a, b, c});
    }
    const shade::OpenRays rays(64);
    const shade::TangentFrame frame({0, 1, 0});
    double difference = 0;
    for (int i = 0; i < 30; ++i) {
        const Vec3d place(number(-4, 4), 0, number(-4, 4));
        int open = 0;
        for (const shade::OpenRay& ray : rays.all()) {
            const Vec3 direction =
                frame.x * ray.direction.x + frame.y * ray.direction.y + Vec3(0, ray.direction.z, 0);
            open += std::ranges::none_of(world.triangles, [&](const auto& triangle) {
                return hits(place, Vec3d(direction), 4.0 * double(ray.length), triangle);
            });
        }
        const double found = openness_at(world, place, occlusion_of(4, 64)) * 64;
        EXPECT_NEAR(found, open, 1.01); // a ray may just graze an edge
        difference += std::fabs(found - open);
    }
    EXPECT_LE(difference, 3);
}

// A facet of something round: its rays go about the interpolated normal, but never into itself.
TEST(Occlusion, LeaningNormalsHideNothing) {
    WhiteWorld world;
    const auto mesh = world.make_mesh(world.white);
    mesh.data->positions = {{-1, 0, 1}, {1, 0, 1}, {0, 0, -1}};
    for (const Vec3& p : mesh.data->positions)
        mesh.data->normals.push_back(glm::normalize(p + Vec3(0, 0.6f, 0)));
    mesh.surface->triangles = {{0, 1, 2}};
    world.scene.meshes.insert({mesh.data});
    for (const double x : {-0.8, -0.3, 0.0, 0.7})
        EXPECT_EQ(openness_at(world, {x, 0, 0.9}, occlusion_of(kInfinity)), 1.0f);
}

//   A trench, seen from above: its sides and its floor
struct TrenchWorld : WhiteWorld {
    explicit TrenchWorld(uint32_t threads = 1, base::Isa isa = base::Isa::best)
        : WhiteWorld(threads, isa) {
        add_floor();
        add_wall(-1.5f, 1);
        add_wall(1.5f, 1);
    }
    Picture view(const Occlusion& occlusion) {
        Camera camera;
        camera.position = {0, 3, 0};
        camera.forward = {0, -1, 0};
        camera.up = {0, 0, -1};
        camera.vertical_fov = 1.2f;
        return take(*this, camera, occlusion, 200, 120);
    }
};

TEST(Occlusion, IsSymmetric) {
    TrenchWorld world;
    const Picture picture = world.view(occlusion_of(3));
    float largest = 0;
    for (uint32_t y = 0; y < picture.height; ++y)
        for (uint32_t x = 20; x < picture.width / 2; ++x)
            largest = std::max(
                largest, std::fabs(picture.at(x, y).x - picture.at(picture.width - 1 - x, y).x));
    EXPECT_LT(largest, 0.04f);
}

TEST(Occlusion, BlocksAreExactAtTheirCornersAndNearBetween) {
    TrenchWorld world;
    const Picture exact = world.view(occlusion_of(3, 32));
    EXPECT_EQ(exact.stats.occlusion_points, 200u * 120u);
    for (const uint32_t block : {4u, 8u, 16u}) {
        const Picture picture = world.view(occlusion_of(3, 32, block));
        double sum = 0;
        for (uint32_t y = 0; y < picture.height; ++y)
            for (uint32_t x = 0; x < picture.width; ++x) {
                const float error = std::fabs(picture.at(x, y).x - exact.at(x, y).x);
                sum += double(error);
                const auto corner = [&](uint32_t i) {
                    return i % block == 0 || i % block == block - 1;
                };
                if (corner(x) && corner(y)) {
                    ASSERT_EQ(error, 0) << x << " " << y;
                }
                ASSERT_LE(error, 0.13f) << x << " " << y;
            }
        EXPECT_LT(sum / (200 * 120), 0.015);
        EXPECT_LT(picture.stats.occlusion_points, exact.stats.occlusion_points / 2);
        EXPECT_EQ(picture.stats.rays_occlusion, picture.stats.occlusion_points * 32);
    }
}

TEST(Occlusion, IsTheSameWithEveryNumberOfThreadsAndInPlainCode) {
    for (const uint32_t block : {1u, 8u}) {
        TrenchWorld one, three(3), plain(1, base::Isa::scalar);
        const Picture picture = one.view(occlusion_of(3, 16, block));
        EXPECT_EQ(picture.pixels, three.view(occlusion_of(3, 16, block)).pixels);
        EXPECT_EQ(picture.pixels, plain.view(occlusion_of(3, 16, block)).pixels);
    }
}

TEST(Occlusion, TakesNothingFromWhatIsNotThere) {
    TrenchWorld world;
    const Picture without = world.view({});
    EXPECT_EQ(without.stats.rays_occlusion, 0u);
    world.scene.environment.ambient = Vec3(0);
    const Picture dark = world.view({}), still_dark = world.view(occlusion_of(3));
    EXPECT_EQ(still_dark.stats.rays_occlusion, 0u);
    EXPECT_EQ(dark.pixels, still_dark.pixels);
}

// Rays at edges ask for themselves, light in blocks gets what was found before.
TEST(Occlusion, WorksWithBlocksOfLightAndEdges) {
    TrenchWorld world;
    Frame frame = test::float_frame(200, 120);
    Camera camera;
    camera.position = {0, 3, 0};
    camera.forward = {0, -1, 0};
    camera.up = {0, 0, -1};
    camera.vertical_fov = 1.2f;
    frame.occlusion = occlusion_of(3, 16);
    const Picture plain = take_picture(world, camera, frame);
    frame.approximations.light_block = 8;
    EXPECT_EQ(plain.pixels, take_picture(world, camera, frame).pixels);
    frame.approximations.edge_samples = 4;
    const Picture fine = take_picture(world, camera, frame);
    EXPECT_EQ(fine.stats.rays_occlusion, plain.stats.rays_occlusion + 16 * fine.stats.rays_edge);
    EXPECT_GT(fine.stats.rays_edge, 0u);
}

TEST(OpenRays, AreDistributedLikeTheCosine) {
    for (const uint32_t count : {1u, 2u, 16u, 64u, 256u}) {
        const shade::OpenRays rays(count);
        Vec3d sum(0);
        double lengths = 0;
        for (const shade::OpenRay& ray : rays.all()) {
            EXPECT_NEAR(glm::length(ray.direction), 1, 1e-6);
            EXPECT_GT(ray.direction.z, 0);
            EXPECT_GT(ray.length, 0);
            EXPECT_LE(ray.length, 1);
            sum += Vec3d(ray.direction);
            lengths += double(ray.length);
        }
        EXPECT_NEAR(lengths / count, 0.5, 1e-6);
        if (count < 16) continue;
        EXPECT_NEAR(sum.x / count, 0, 0.06);
        EXPECT_NEAR(sum.y / count, 0, 0.06);
        EXPECT_NEAR(sum.z / count, 2.0 / 3, 0.01);
    }
}

TEST(TangentFrames, AreOrthonormalEverywhereAndTurnWithTheNormal) {
    std::mt19937 random(3);
    std::normal_distribution<float> number;
    for (int i = 0; i < 20000; ++i) {
        Vec3 normal = glm::normalize(Vec3(number(random), number(random), number(random)));
        if (i == 0) normal = Vec3(19, -26, -22) / 39.0f; // where no frame turns with it
        const shade::TangentFrame frame(normal);
        ASSERT_NEAR(glm::length(frame.x), 1, 1e-4);
        ASSERT_NEAR(glm::length(frame.y), 1, 1e-4);
        ASSERT_NEAR(glm::dot(frame.x, frame.y), 0, 1e-4);
        ASSERT_NEAR(glm::dot(frame.x, normal), 0, 1e-4);
        ASSERT_NEAR(glm::dot(frame.y, normal), 0, 1e-4);
    }
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
        for (const float sign : {1.0f, -1.0f}) {
            const Vec3 near = glm::normalize(axis * sign + Vec3(1e-6f, -1e-6f, 1e-6f));
            const shade::TangentFrame a(axis * sign), b(near);
            EXPECT_LT(glm::length(a.x - b.x), 1e-4f);
            EXPECT_LT(glm::length(a.y - b.y), 1e-4f);
        }
}

} // namespace
} // namespace peregrine::render
