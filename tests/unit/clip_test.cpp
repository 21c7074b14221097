#include "geometry/clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace peregrine::geometry {
namespace {

Triangle make(const Vec3& a, const Vec3& b, const Vec3& c) {
    Triangle triangle{};
    triangle.v0 = a;
    triangle.v1 = b;
    triangle.v2 = c;
    return triangle;
}

void expect_near(const Box& box, const Vec3& lower, const Vec3& upper, float tolerance) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_LE(box.lower[i], lower[i]);
        EXPECT_GE(box.upper[i], upper[i]);
        EXPECT_NEAR(box.lower[i], lower[i], tolerance);
        EXPECT_NEAR(box.upper[i], upper[i], tolerance);
    }
}

bool holds(const Box& box, const math::Vec3d& p) {
    for (int i = 0; i < 3; ++i)
        if (p[i] < double(box.lower[i]) || p[i] > double(box.upper[i])) return false;
    return true;
}

// Numbers of few bits: points of the triangle with weights i / 64 are exact in double.
struct Exact {
    std::mt19937 random{7};

    uint32_t below(uint32_t n) { return uint32_t(random()) % n; }
    float coordinate() { return float(below(4096)) / 16.0f - 128.0f; }
    Vec3 point() { return {coordinate(), coordinate(), coordinate()}; }

    Triangle triangle() { return make(point(), point(), point()); }

    Box cell() {
        Box box;
        box.extend(point());
        box.extend(point());
        return box;
    }

    math::Vec3d inside(const Triangle& t) {
        uint32_t u = below(65);
        uint32_t v = below(65);
        if (u + v > 64) u = 64 - u, v = 64 - v;
        return (math::Vec3d(t.v0) * double(64 - u - v) + math::Vec3d(t.v1) * double(u)
                + math::Vec3d(t.v2) * double(v))
               / 64.0;
    }
};

//   y
//   4 |\.
//   2 +-+\---+      the cell's corner cuts the triangle to a trapezium: x 0..4, y 0..2
//     | | \  |
//   0 +----\-+
//     0    4 6
TEST(Clip, CutsAKnownTriangle) {
    const Triangle triangle = make({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    const Box cell{{0, 0, -1}, {6, 2, 1}};
    expect_near(clip(triangle, cell), {0, 0, 0}, {4, 2, 0}, 0);
    const ClippedHalves halves = clip_to_halves(triangle, cell, 0, 3, bounds(triangle));
    expect_near(halves.below, {0, 0, 0}, {3, 2, 0}, 0);
    expect_near(halves.above, {3, 0, 0}, {4, 1, 0}, 1e-6f);
}

//     \         the triangle's long side passes by the cell's corner
//   +--+ \.
//   |  |   \.
//   +--+-----\.
TEST(Clip, SeesThatOnlyTheBoundsOverlap) {
    const Triangle triangle = make({4, 0, 0}, {0, 4, 0}, {4, 4, 0});
    EXPECT_TRUE(clip(triangle, {{0, 0, -1}, {1.9f, 1.9f, 1}}).empty());
    EXPECT_FALSE(clip(triangle, {{0, 0, -1}, {2, 2, 1}}).empty());
}

TEST(Clip, KeepsATriangleInsideAsItIs) {
    const Triangle triangle = make({0.1f, 0.2f, 0.3f}, {0.7f, 0.1f, 0.9f}, {0.3f, 0.8f, 0.5f});
    const Box box = clip(triangle, {{-1, -1, -1}, {1, 1, 1}});
    EXPECT_EQ(box.lower, bounds(triangle).lower);
    EXPECT_EQ(box.upper, bounds(triangle).upper);
}

TEST(Clip, NeverWidensPlanarTriangles) {
    const Triangle triangle = make({0, 0.1f, 0}, {4, 0.1f, 0}, {0, 0.1f, 4});
    const Box box = clip(triangle, {{1, -1, 1}, {2, 1, 2}});
    EXPECT_EQ(box.lower.y, 0.1f);
    EXPECT_EQ(box.upper.y, 0.1f);
}

TEST(Clip, HoldsEveryCommonPoint) {
    Exact exact;
    uint32_t common = 0;
    for (int i = 0; i < 20000; ++i) {
        const Triangle triangle = exact.triangle();
        const Box cell = exact.cell();
        const Box box = clip(triangle, cell);
        for (int k = 0; k < 20; ++k) {
            const math::Vec3d p = exact.inside(triangle);
            if (!holds(cell, p)) continue;
            ++common;
            ASSERT_TRUE(holds(box, p));
        }
    }
    EXPECT_GT(common, 1000u);
}

TEST(Clip, HalvesHoldEveryCommonPoint) {
    Exact exact;
    for (int i = 0; i < 20000; ++i) {
        const Triangle triangle = exact.triangle();
        const Box cell = exact.cell();
        const uint32_t axis = exact.below(3);
        const float split = exact.coordinate();
        const ClippedHalves halves =
            clip_to_halves(triangle, cell, axis, split, clip(triangle, cell));
        for (int k = 0; k < 20; ++k) {
            const math::Vec3d p = exact.inside(triangle);
            if (!holds(cell, p)) continue;
            ASSERT_TRUE(p[int(axis)] > double(split) || holds(halves.below, p));
            ASSERT_TRUE(p[int(axis)] < double(split) || holds(halves.above, p));
        }
    }
}

// Corners of the cell that are points of the triangle: the least that can be in common.
TEST(Clip, HoldsASinglePointAtAnyScale) {
    Exact exact;
    for (int exponent = -140; exponent <= 90; exponent += 10) {
        for (int i = 0; i < 500; ++i) {
            const Triangle t = make({-1.5f, -1, 0.25f}, {1, -0.75f, 2}, {0.5f, 1.25f, -3});
            const math::Vec3d p = exact.inside(t);
            const float scale = std::ldexp(1.0f, exponent);
            const Triangle scaled = make(t.v0 * scale, t.v1 * scale, t.v2 * scale);
            const Vec3 corner = Vec3(p) * scale;
            const Box cell{corner, corner};
            // Denormal corners are rounded and need not lie in the triangle.
            ASSERT_TRUE(math::Vec3d(corner) != p * double(scale) || !clip(scaled, cell).empty());
        }
    }
}

} // namespace
} // namespace peregrine::geometry
