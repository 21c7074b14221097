// Promise 1 of docs/design.md: every kernel gives the bits of brute force.
#include "exact_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace peregrine::test {
namespace {

TEST(Structures, AreKnown) {
    EXPECT_TRUE(std::ranges::any_of(kStructures, is_wanted))
        << "PEREGRINE_STRUCTURE must be bvh, compact, kdtree or bih";
}

class SceneTest : public testing::TestWithParam<std::string> {};

TEST_P(SceneTest, EqualsBruteForce) {
    const SceneFile scene = load_scene(GetParam());
    ASSERT_FALSE(scene.triangles.empty());
    World world(scene.triangles);
    const auto make_sets = [&](size_t rays, uint32_t seed) {
        return make_ray_sets(world.triangles, scene.eyes, scene.lights, rays, seed);
    };
    compare_all(world, make_sets(rays_per_set(500), 7));
    compare_qualities(world, make_sets((rays_per_set(500) + 3) / 4, 8));
}

std::vector<std::string> files() {
    std::vector<std::string> names = scene_names();
    names.push_back("hall");
    return names;
}

INSTANTIATE_TEST_SUITE_P(Files, SceneTest, testing::ValuesIn(files()),
                         [](const auto& info) { return info.param; });

TEST(SceneFiles, AreThere) {
    if (scene_names().empty())
        GTEST_SKIP() << "no scenes of others: set PEREGRINE_SCENES to a folder of .glb files";
}

} // namespace
} // namespace peregrine::test
