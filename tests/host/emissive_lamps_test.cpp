// Lamps in the place of what glows, against the integral over its triangles.
#include <algorithm>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "emissive_lamps.h"

namespace host::test {
namespace {

using glm::dvec3;
constexpr double pi = 3.14159265358979;

Level make_level(bool double_sided = false) {
    Level level;
    Material glow;
    glow.emissive = {4, 2, 1};
    glow.double_sided = double_sided;
    level.materials = {glow, Material{}};
    level.meshes.emplace_back();
    return level;
}

void add_triangle(Mesh& mesh, const dvec3& a, const dvec3& b, const dvec3& c, uint32_t material) {
    for (const dvec3& corner : {a, b, c}) {
        mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
        mesh.positions.emplace_back(corner);
    }
    mesh.materials.push_back(material);
}

void add_quad(Mesh& mesh, const dvec3& corner, const dvec3& u, const dvec3& v,
              uint32_t material = 0) {
    add_triangle(mesh, corner, corner + u, corner + u + v, material);
    add_triangle(mesh, corner, corner + u + v, corner + v, material);
}

// Faces outward.
void add_box(Mesh& mesh, double half) {
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            dvec3 w(0), u(0), v(0);
            w[axis] = side * half;
            u[(axis + 1) % 3] = 2 * half;
            v[(axis + 2) % 3] = 2 * half * side;
            add_quad(mesh, w - 0.5 * (u + v), u, v);
        }
}

void add_ball(Mesh& mesh, double radius) {
    constexpr int rings = 16, sectors = 32;
    const auto at = [&](int i, int j) {
        const double a = pi * i / rings, b = 2 * pi * j / sectors;
        return radius * dvec3(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            if (i > 0) add_triangle(mesh, at(i, j), at(i, j + 1), at(i + 1, j), 0);
            if (i + 1 < rings) add_triangle(mesh, at(i, j + 1), at(i + 1, j + 1), at(i + 1, j), 0);
        }
}

// What a surface gets that faces along `normal`, in parts of the radiance: convex glows alone,
// which hide nothing of themselves.
double integrate(const Mesh& mesh, const dvec3& place, const dvec3& normal, int cells) {
    double sum = 0;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        const dvec3 a(mesh.positions[3 * t]), u = dvec3(mesh.positions[3 * t + 1]) - a,
                                              v = dvec3(mesh.positions[3 * t + 2]) - a;
        const dvec3 area = 0.5 * glm::cross(u, v) / double(cells * cells);
        for (int i = 0; i < cells; ++i)
            for (int j = 0; j < 2 * (cells - i) - 1; ++j) {
                const double third = j % 2 ? 2.0 / 3 : 1.0 / 3;
                const dvec3 from = a + u * ((i + third) / cells) + v * ((j / 2 + third) / cells);
                const dvec3 way = place - from;
                const double square = glm::dot(way, way);
                sum += std::max(glm::dot(area, way), 0.0) * std::max(-glm::dot(normal, way), 0.0)
                       / (square * square);
            }
    }
    return sum;
}

// By docs/light.md, without the window and without shadows.
double shine(const std::vector<Light>& lights, const dvec3& place, const dvec3& normal) {
    double sum = 0;
    for (const Light& light : lights) {
        const dvec3 way = place - light.position;
        const double square = glm::dot(way, way), distance = std::sqrt(square);
        const double s = std::max(glm::dot(dvec3(light.direction), way) / distance, 0.0);
        sum += double(light.intensity.y) / 2 * s * s * (3 - 2 * s)
               * std::max(-glm::dot(normal, way), 0.0) / (distance * square);
    }
    return sum;
}

// The largest error over a sphere of so many radii about what glows, in parts of the brightest
// place.
double worst_error(const Level& level, double distance, int cells) {
    const EmissiveLamps found = find_emissive_lamps(level, 64);
    double worst = 0, brightest = 0;
    for (int i = 0; i <= 12; ++i)
        for (int j = 0; j < 6; ++j) {
            const double a = pi * i / 12, b = 2 * pi * (j + 0.3) / 6;
            const dvec3 out(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
            const double exact = integrate(level.meshes[0], distance * out, -out, cells);
            worst = std::max(worst, std::fabs(shine(found.lights, distance * out, -out) - exact));
            brightest = std::max(brightest, exact);
        }
    return worst / brightest;
}

Level square_level() {
    Level level = make_level();
    add_quad(level.meshes[0], {-0.1, -0.1, 0}, {0.2, 0, 0}, {0, 0.2, 0});
    return level;
}

constexpr double square_radius = 0.2 / 1.7724538509; // of a disc of its area

// Straight before it the lamp is an eighth of a radius nearer than the square.
TEST(EmissiveLamps, BeforeASquare) {
    const Level level = square_level();
    const EmissiveLamps found = find_emissive_lamps(level, 64);
    ASSERT_EQ(found.lights.size(), 1u);
    EXPECT_EQ(found.left_out, 0.0);
    EXPECT_NEAR(found.power, pi * 0.04 * 7 / 3, 1e-6);
    for (const auto& [radii, error] : {std::pair{4.0, 0.14}, {8.0, 0.05}, {16.0, 0.03}}) {
        const dvec3 place(0, 0, radii * square_radius);
        const double exact = integrate(level.meshes[0], place, {0, 0, -1}, 32);
        const double lamp = shine(found.lights, place, {0, 0, -1});
        EXPECT_NEAR(lamp / exact, 1, error) << radii;
    }
}

TEST(EmissiveLamps, AllAround) {
    Level box = make_level(), ball = make_level();
    add_box(box.meshes[0], 0.1);
    add_ball(ball.meshes[0], 0.1);
    for (const auto& [radii, of_square, of_box, of_ball] :
         {std::tuple{4.0, 0.19, 0.11, 0.3}, {8.0, 0.13, 0.11, 0.17}, {16.0, 0.12, 0.11, 0.19}}) {
        EXPECT_LT(worst_error(square_level(), radii * square_radius, 8), of_square) << radii;
        EXPECT_LT(worst_error(box, radii * 0.1732, 8), of_box) << radii;
        EXPECT_LT(worst_error(ball, radii * 0.1, 1), of_ball) << radii;
    }
    EXPECT_EQ(find_emissive_lamps(box, 64).lights.size(), 6u);
    EXPECT_EQ(find_emissive_lamps(ball, 64).lights.size(), 8u);
}

TEST(EmissiveLamps, HaveThePowerOfWhatGlows) {
    Level ball = make_level();
    add_ball(ball.meshes[0], 0.1);
    for (const uint32_t most : {1u, 4u, 8u, 64u}) {
        const EmissiveLamps found = find_emissive_lamps(ball, most);
        EXPECT_LE(found.lights.size(), most);
        if (most == 1) continue; // it faces all around, and so no way at all
        double power = 0;
        for (const Light& light : found.lights)
            power += pi * double(light.intensity.x + light.intensity.y + light.intensity.z) / 3;
        EXPECT_NEAR(power, found.power, 1e-5 * power) << most;
    }
}

TEST(EmissiveLamps, StandBeforeWhatGlows) {
    Level level = make_level(true);
    add_quad(level.meshes[0], {-0.1, -0.1, 0}, {0.2, 0, 0}, {0, 0.2, 0});
    level.origin = {1000, 0, 0};
    const EmissiveLamps found = find_emissive_lamps(level, 64);
    ASSERT_EQ(found.lights.size(), 2u) << "one for each side";
    for (const Light& light : found.lights) {
        EXPECT_GT(double(light.direction.z) * light.position.z, double(light.source_radius));
        EXPECT_NEAR(light.position.x, 1000, 1e-9);
        EXPECT_NEAR(light.intensity.x, 4 * 0.04, 1e-6);
        EXPECT_EQ(light.cone_outer_cos, 0.0f);
    }
}

// A panel of 8 m by 2 m is cut into pieces no wider than two metres, and so they are round enough.
TEST(EmissiveLamps, LargePanelsAreCut) {
    Level level = make_level();
    add_quad(level.meshes[0], {-4, -1, 0}, {8, 0, 0}, {0, 2, 0});
    const EmissiveLamps found = find_emissive_lamps(level, 64);
    EXPECT_GE(found.lights.size(), 4u);
    for (const double x : {-3.0, 0.0, 2.2}) {
        const double exact = integrate(level.meshes[0], {x, 0.2, 3}, {0, 0, -1}, 32);
        const double lamps = shine(found.lights, {x, 0.2, 3}, {0, 0, -1});
        EXPECT_NEAR(lamps / exact, 1, 0.25);
    }
}

TEST(EmissiveLamps, TheStrongestStay) {
    Level level = make_level();
    for (int i = 0; i < 5; ++i)
        add_quad(level.meshes[0], {2.0 * i, 0, 0}, {0.1 * (i + 1), 0, 0}, {0, 0.1, 0});
    const EmissiveLamps found = find_emissive_lamps(level, 3);
    ASSERT_EQ(found.lights.size(), 3u);
    EXPECT_NEAR(found.left_out / found.power, 3.0 / 15, 1e-6);
    for (const Light& light : found.lights) EXPECT_GT(light.position.x, 3);
}

TEST(EmissiveLamps, NeitherMattNorUnlitShines) {
    Level level = make_level();
    add_quad(level.meshes[0], {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
    add_quad(level.meshes[0], {0, 0, 5}, {1, 0, 0}, {0, 1, 0}, no_index);
    EXPECT_TRUE(find_emissive_lamps(level, 64).lights.empty());
    level.materials[1].emissive = glm::vec3(1.0f);
    level.materials[1].unlit = true;
    EXPECT_TRUE(find_emissive_lamps(level, 64).lights.empty());
    EXPECT_TRUE(find_emissive_lamps(Level{}, 64).lights.empty());
}

// The mean of a texture's light: half of its texels are white, the others black.
TEST(EmissiveLamps, TexturesCountByTheirMean) {
    Level level = square_level();
    level.images.push_back({"", 2, 1, {255, 255, 255, 255, 0, 0, 0, 255}});
    level.textures.push_back({0, true, false, Wrap::repeat, Wrap::repeat});
    level.materials[0].emissive_texture.texture = 0;
    EXPECT_NEAR(find_emissive_lamps(level, 64).lights.at(0).intensity.x, 4 * 0.04 / 2, 1e-6);
}

} // namespace
} // namespace host::test
