// Closed meshes leak nothing, also where everybody looks for leaks: at vertices and on edges.
#include "support/closed_meshes.h"
#include "support/world.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace peregrine::test {
namespace {

using math::Vec3;

// Rays from around the middle to vertices, to points of edges and anywhere; every one must hit.
uint64_t count_leaks(const ClosedMesh& mesh, const Vec3& offset, float scale, uint64_t rays) {
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
