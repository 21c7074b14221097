// Closed meshes leak nothing, also where everybody looks for leaks: at vertices and on edges.
#include "support/world.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <map>
#include <thread>

namespace peregrine::test {
namespace {

using math::Vec3;

struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<std::array<uint32_t, 3>> faces;
};

Mesh icosphere(int subdivisions) {
    const float g = (1 + std::sqrt(5.0f)) / 2;
    Mesh mesh{{{-1, g, 0},
               {1, g, 0},
               {-1, -g, 0},
               {1, -g, 0},
               {0, -1, g},
               {0, 1, g},
               {0, -1, -g},
               {0, 1, -g},
               {g, 0, -1},
               {g, 0, 1},
               {-g, 0, -1},
               {-g, 0, 1}},
              {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
               {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
               {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    for (int s = 0; s < subdivisions; ++s) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [at, added] =
                middles.try_emplace(std::minmax(a, b), uint32_t(mesh.vertices.size()));
            if (added) mesh.vertices.push_back(0.5f * (mesh.vertices[a] + mesh.vertices[b]));
            return at->second;
        };
        std::vector<std::array<uint32_t, 3>> faces;
        for (const auto& [a, b, c] : mesh.faces) {
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            faces.insert(faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.faces = faces;
    }
    for (Vec3& v : mesh.vertices) v = glm::normalize(v);
    return mesh;
}

// A box of n x n quads a side; shared vertices are equal to the bit.
Mesh box(int n) {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const auto at = [&](int a, int b) {
                        Vec3 p;
                        p[axis] = side ? 1.0f : -1.0f;
                        p[(axis + 1) % 3] = -1 + 2 * float(a) / float(n);
                        p[(axis + 2) % 3] = -1 + 2 * float(b) / float(n);
                        mesh.vertices.push_back(p);
                        return uint32_t(mesh.vertices.size() - 1);
                    };
                    const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1),
                                   d = at(i, j + 1);
                    mesh.faces.push_back({a, b, c});
                    mesh.faces.push_back({a, c, d});
                }
    return mesh;
}

// Rays from around the middle to vertices, to points of edges and anywhere; every one must hit.
uint64_t count_leaks(const Mesh& mesh, const Vec3& offset, float scale, uint64_t rays) {
    TriangleList list;
    for (const auto& [a, b, c] : mesh.faces)
        list.add(scale * mesh.vertices[a] + offset, scale * mesh.vertices[b] + offset,
                 scale * mesh.vertices[c] + offset);
    const World world(list.triangles);
    const trace::Kernels& kernels = *trace::select_kernels(trace::Structure::bvh, base::Isa::best);
    const trace::Target target = world.target();
    std::atomic<uint64_t> leaks{0};
    const auto work = [&](uint32_t seed, uint64_t count) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(-1, 1);
        for (uint64_t i = 0; i < count; ++i) {
            const Vec3 origin =
                offset + scale * 0.4f * Vec3(unit(random), unit(random), unit(random));
            const auto& triangle = world.triangles[random() % world.triangles.size()];
            Vec3 aim = triangle.v0;
            if (i % 4 == 1) aim = 0.5f * (triangle.v0 + triangle.v1);
            if (i % 4 == 2)
                aim = triangle.v1 + std::fabs(unit(random)) * (triangle.v2 - triangle.v1);
            Vec3 direction = aim - origin;
            if (i % 4 == 3) direction = {unit(random), unit(random), unit(random)};
            if (direction == Vec3(0)) continue;
            const math::Ray ray{origin, 0, direction, std::numeric_limits<float>::infinity()};
            const bool hit =
                i & 4 ? kernels.occluded(target, ray, {})
                      : kernels.closest(target, ray, {}).triangle != geometry::kNoTriangle;
            if (!hit) ++leaks;
        }
    };
    std::vector<std::jthread> threads;
    for (uint32_t t = 0; t < 2; ++t) threads.emplace_back(work, t, rays / 2);
    threads.clear();
    return leaks;
}

// 10 million in all with PEREGRINE_RAYS=1000000.
uint64_t rays() {
    return rays_per_set(100'000);
}

TEST(Watertight, Icosphere) {
    EXPECT_EQ(count_leaks(icosphere(5), Vec3(0), 1, 2 * rays()), 0u);
    EXPECT_EQ(count_leaks(icosphere(2), Vec3(0), 1, 2 * rays()), 0u);
}
TEST(Watertight, Box) {
    EXPECT_EQ(count_leaks(box(8), Vec3(0), 1, 2 * rays()), 0u);
    EXPECT_EQ(count_leaks(box(1), Vec3(0), 1, rays()), 0u);
}
TEST(Watertight, FarAway) {
    EXPECT_EQ(count_leaks(icosphere(4), Vec3(2300, -1700, 900), 1, rays()), 0u);
    EXPECT_EQ(count_leaks(box(4), Vec3(2300, -1700, 900), 3, rays()), 0u);
}
TEST(Watertight, TinyAndHuge) {
    EXPECT_EQ(count_leaks(icosphere(3), Vec3(0), 1e-20f, rays() / 2), 0u);
    EXPECT_EQ(count_leaks(icosphere(3), Vec3(0), 1e20f, rays() / 2), 0u);
}

} // namespace
} // namespace peregrine::test
