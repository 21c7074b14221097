// Triangles that somebody thought of to make kernels fail.
#include "exact_comparison.h"
#include "support/adversaries.h"

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

void expect_exact(std::vector<geometry::Triangle> triangles, size_t rays = 2000) {
    World world(std::move(triangles));
    compare_all(world, make_ray_sets(world.triangles, {}, {}, rays_per_set(rays), 11));
    compare_qualities(world, make_ray_sets(world.triangles, {}, {}, rays_per_set(rays) / 4, 12));
}

TEST(Adversary, Soup) {
    expect_exact(soup(1, 3000, 0.1f, 1));
}
TEST(Adversary, LargeTriangles) {
    expect_exact(soup(2, 300, 2, 1));
}
TEST(Adversary, OneTriangle) {
    expect_exact(soup(3, 1, 1, 1));
}
TEST(Adversary, TwoTriangles) {
    expect_exact(soup(4, 2, 1, 1));
}

TEST(Adversary, Scales) {
    for (const float scale : {1e-38f, 1e-30f, 1e-20f, 1e-6f, 1e6f, 1e15f, 1e20f, 4e29f})
        expect_exact(soup(5, 200, 0.3f, scale), 500);
}

TEST(Adversary, MixedScales) {
    std::vector<geometry::Triangle> triangles = soup(6, 300, 0.3f, 1e6f);
    for (geometry::Triangle triangle : soup(7, 300, 0.3f, 1e-6f)) {
        triangle.mesh = 1;
        triangles.push_back(triangle);
    }
    expect_exact(triangles);
}

TEST(Adversary, Lattice) {
    expect_exact(lattice(), 4000);
}

TEST(Adversary, CoincidentTriangles) {
    expect_exact(coincident(500), 500);
}

TEST(Adversary, TwoSidedTriangles) {
    expect_exact(two_sided(400), 1000);
}

TEST(Adversary, Needles) {
    expect_exact(needles(500));
}

// Sizes in a geometric series towards one corner, which asks for a deep tree.
TEST(Adversary, GeometricSeries) {
    TriangleList list;
    for (float size = 1; size > 1e-30f; size *= 0.7f)
        list.add({size, 0, 0}, {0, size, 0}, {size, size, size});
    expect_exact(list.triangles);
}

// The tessellated diagonal wall whose fans grow ever more slender.
TEST(Adversary, Fan) {
    TriangleList list;
    for (int i = 0; i < 1000; ++i) {
        const float a = float(i) * 1e-3f, b = float(i + 1) * 1e-3f;
        list.add({0, 0, 0}, {1, a * a, a}, {1, b * b, b});
    }
    expect_exact(list.triangles);
}

} // namespace
} // namespace peregrine::test
