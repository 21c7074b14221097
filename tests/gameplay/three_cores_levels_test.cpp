// Plans for levels that name nothing of the game, and whether a person can do what they ask for.
#include "gltf/import.h"
#include "support/arena.h"
#include "support/plan_check.h"
#include "support/world.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

namespace peregrine::test {
namespace {

using three_cores::complete_plan;
using three_cores::Plan;

void fill(Arena& arena, const host::Level& level) {
    for (const host::Mesh& mesh : level.meshes)
        for (size_t i = 0; i < mesh.indices.size(); i += 3)
            arena.add_triangle(mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                               mesh.positions[mesh.indices[i + 2]]);
    arena.commit();
}

Plan unplanned(const host::Level& level, bool with_spawns) {
    Plan plan;
    plan.lower = level.bounds.lower;
    plan.upper = level.bounds.upper;
    if (with_spawns)
        for (const host::Viewpoint& spawn : level.spawns)
            plan.spawns.push_back({spawn.position - Vec3(0, 1.7, 0), {0, 0, -1}});
    return plan;
}

double seconds_to_complete(Plan& plan, const gameplay::World& world) {
    const auto start = std::chrono::steady_clock::now();
    complete_plan(plan, world);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void expect_playable(const std::string& path, const host::Level& level, bool with_spawns) {
    SCOPED_TRACE(path + (with_spawns ? "" : ", without its spawns"));
    Arena arena;
    fill(arena, level);
    Plan plan = unplanned(level, with_spawns);
    const double seconds = seconds_to_complete(plan, arena.world());
    EXPECT_LT(seconds, 20); // of any build, on a busy machine
    ASSERT_FALSE(plan.spawns.empty());
    EXPECT_EQ(plan.cores.size(), 3u);
    EXPECT_EQ(plan.exits.size(), 1u);
    EXPECT_FALSE(plan.patrols.empty());
    expect_free_rounds(arena.world(), plan);
    const Walk walk = walk_plan(arena.world(), plan);
    EXPECT_EQ(walk.reached, walk.goals);
    std::printf("%s%s: %.2f s, %zu spawns, %zu patrols of %.0f m, %zu of %zu goals in %.0f m\n",
                path.substr(path.rfind('/') + 1).c_str(), with_spawns ? "" : ", no spawns", seconds,
                plan.spawns.size(), plan.patrols.size(), length_of_rounds(plan), walk.reached,
                walk.goals, walk.metres);

    for (const rt_isa isa : {RT_ISA_SCALAR, RT_ISA_AVX2}) {
        Arena other(isa);
        if (!other.is_supported()) continue;
        fill(other, level);
        Plan again = unplanned(level, with_spawns);
        complete_plan(again, other.world());
        EXPECT_EQ(hash(again), hash(plan));
    }
}

TEST(ThreeCoresLevels, ThoseOfTheProject) {
    for (const char* name : {"hall", "mill"}) {
        const std::string path = std::string(PEREGRINE_SOURCE_DIR) + "/content/" + name + ".glb";
        const host::Level level = host::gltf::import_file(path);
        expect_playable(path, level, true);
        expect_playable(path, level, false);
    }
}

TEST(ThreeCoresLevels, ThoseOfOthers) {
    if (scene_names().empty()) GTEST_SKIP() << "no scenes: see PEREGRINE_SCENES";
    for (const std::string& name : scene_names()) {
        const std::string path = scenes_folder() + "/" + name + ".glb";
        const host::Level level = host::gltf::import_file(path);
        if (!level.spawns.empty()) expect_playable(path, level, true);
        expect_playable(path, level, false);
    }
}

} // namespace
} // namespace peregrine::test
