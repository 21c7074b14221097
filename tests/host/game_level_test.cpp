#include <gtest/gtest.h>

#include "game/node_names.h"
#include "game/plan_from_level.h"
#include "gltf/import.h"
#include "gltf_builder.h"

// From a level's named nodes to the plan of the game.
namespace host::test {
namespace {

using game::Role;
using three_cores::Vec3;

constexpr const char* hall = PEREGRINE_SOURCE_DIR "/content/hall.glb";

// As the engine would hand them out; what they stand for does not matter here.
Uploaded fake_handles(const Level& level) {
    Uploaded uploaded;
    uint32_t index = 0;
    for (const RigidMesh& rigid : level.rigid_meshes) {
        auto& handles = uploaded.rigid_meshes.emplace_back();
        for (size_t i = 0; i < rigid.nodes.size(); ++i) handles.push_back({++index, 1});
    }
    return uploaded;
}

three_cores::Plan plan_of(const Level& level) {
    return game::plan_from_level(level, fake_handles(level));
}

void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_LT(glm::length(a - b), 1e-6) << a.x << " " << a.y << " " << a.z;
}

// A triangle at the nodes of these names, the first one at x = 1, the next at x = 2, ...
GltfBuilder triangle_at(std::initializer_list<const char*> names) {
    GltfBuilder builder = make_quad();
    const Json mesh = builder.json["nodes"][0]["mesh"];
    builder.json["nodes"] = Json::array();
    builder.json["scenes"][0]["nodes"] = Json::array();
    for (const char* name : names) {
        const auto x = 1 + builder.json["nodes"].size();
        builder.push("nodes", {{"name", name}, {"mesh", mesh}, {"translation", {x, 0, 0}}});
        builder.json["scenes"][0]["nodes"].push_back(x - 1);
    }
    return builder;
}

void add_place(GltfBuilder& builder, const char* name, double x, double y, double z) {
    const int node = builder.push("nodes", {{"name", name}, {"translation", {x, y, z}}});
    builder.json["scenes"][0]["nodes"].push_back(node);
}

TEST(NodeNames, AreRead) {
    EXPECT_EQ(game::parse_node_name("crate_12")->number, 12u);
    EXPECT_EQ(game::parse_node_name("door_left_3")->number, 6u);
    EXPECT_EQ(game::parse_node_name("door_right_3")->number, 7u);
    EXPECT_EQ(game::parse_node_name("lift_0")->role, Role::lift);
    EXPECT_EQ(game::parse_node_name("lift_0_top")->role, Role::lift_top);
    EXPECT_EQ(game::parse_node_name("gate_1_exit")->role, Role::gate_exit);
    const auto patrol = game::parse_node_name("patrol_4_11");
    ASSERT_TRUE(patrol);
    EXPECT_EQ(patrol->number, 4u);
    EXPECT_EQ(patrol->step, 11u);
}

TEST(NodeNames, WithoutAMeaningAreNothing) {
    for (const char* name :
         {"", "crate", "crate_", "crate_x", "crate_1_2", "crate_-1", "crate_ 1", "lift_0_bottom",
          "patrol_1", "patrol_1_", "gate_exit", "door_left", "door_3", "my_crate_1",
          "core_99999999999999999999", "core_1234567", "core_0_top"})
        EXPECT_FALSE(game::parse_node_name(name)) << name;
    EXPECT_TRUE(game::is_moved("gate_0"));
    EXPECT_FALSE(game::is_moved("gate_0_exit"));
    EXPECT_FALSE(game::is_moved("core_0"));
}

TEST(MovedNodes, AreRigidOnlyIfTheHostSaysSo) {
    const std::string bytes = triangle_at({"crate_0", "rock_0", "crate_1"}).glb();
    const Level still = gltf::import_bytes(bytes, "test");
    EXPECT_TRUE(still.rigid_meshes.empty());
    const Level level = gltf::import_bytes(bytes, "test", gltf::no_animation, game::is_moved);
    ASSERT_EQ(level.rigid_meshes.size(), 1u); // shared
    EXPECT_EQ(level.rigid_meshes[0].nodes.size(), 2u);
    EXPECT_EQ(level.triangle_count(), still.triangle_count());
    EXPECT_EQ(level.bounds.lower, still.bounds.lower);
    EXPECT_EQ(level.bounds.upper, still.bounds.upper);
    EXPECT_TRUE(level.rig.clips.empty());
}

TEST(Plan, SortsByNumberNotByPlaceInTheFile) {
    GltfBuilder builder = triangle_at({"crate_10", "crate_9", "door_right_0", "door_left_0"});
    add_place(builder, "core_2", 2, 0, 0);
    add_place(builder, "core_1", 1, 0, 0);
    add_place(builder, "patrol_1_10", 10, 0, 1);
    add_place(builder, "patrol_1_9", 9, 0, 1);
    add_place(builder, "patrol_0_0", 0, 0, 0);
    add_place(builder, "spawn_0", 3, 1.7, 4);
    const Level level =
        gltf::import_bytes(builder.glb(), "test", gltf::no_animation, game::is_moved);
    const auto plan = plan_of(level);
    ASSERT_EQ(plan.crates.size(), 2u);
    EXPECT_EQ(plan.crates[0].rest.m[3], 2); // crate_9
    EXPECT_EQ(plan.crates[1].rest.m[3], 1);
    ASSERT_EQ(plan.doors.size(), 2u);
    EXPECT_EQ(plan.doors[0].rest.m[3], 4); // the left leaf
    ASSERT_EQ(plan.cores.size(), 2u);
    EXPECT_EQ(plan.cores[0].x, 1);
    ASSERT_EQ(plan.patrols.size(), 2u);
    EXPECT_EQ(plan.patrols[1][0].x, 9);
    ASSERT_EQ(plan.spawns.size(), 1u);
    expect_near(plan.spawns[0].feet, {3, 0, 4});
    expect_near(plan.spawns[0].forward, {0, 0, -1});
    EXPECT_NE(plan.crates[0].meshes[0].index, plan.crates[1].meshes[0].index);
}

TEST(Plan, OfANodeWithoutMeaningKnowsNothing) {
    const Level level = gltf::import_bytes(triangle_at({"rock_0"}).glb(), "test",
                                           gltf::no_animation, game::is_moved);
    const auto plan = plan_of(level);
    EXPECT_TRUE(plan.crates.empty() && plan.doors.empty() && plan.cores.empty());
    EXPECT_TRUE(plan.spawns.empty() && plan.exits.empty() && plan.patrols.empty());
}

TEST(Plan, TellsLevelsApartByWhatIsInThem) {
    const auto id = [](const GltfBuilder& builder) {
        return plan_of(
                   gltf::import_bytes(builder.glb(), "test", gltf::no_animation, game::is_moved))
            .level;
    };
    GltfBuilder named = triangle_at({"crate_0", "rock"});
    named.json["nodes"][1]["name"] = "stone";
    EXPECT_EQ(id(triangle_at({"crate_0", "rock"})), id(named));
    EXPECT_NE(id(triangle_at({"crate_0", "rock"})), id(triangle_at({"rock", "crate_0"})));
    GltfBuilder with_core = triangle_at({"crate_0", "rock"});
    add_place(with_core, "core_0", 0, 0, 0);
    EXPECT_NE(id(triangle_at({"crate_0", "rock"})), id(with_core));
}

TEST(Plan, OfTheHall) {
    const Level level = gltf::import_file(hall, gltf::no_animation, game::is_moved);
    const auto plan = plan_of(level);
    EXPECT_EQ(plan.spawns.size(), 9u);
    EXPECT_EQ(plan.cores.size(), 3u);
    EXPECT_EQ(plan.patrols.size(), 7u);
    EXPECT_EQ(plan.patrols[0].size(), 4u);
    EXPECT_EQ(plan.doors.size(), 8u);
    EXPECT_EQ(plan.crates.size(), 15u);
    EXPECT_EQ(plan.exits.size(), 1u);
    EXPECT_EQ(plan.lamps.size(), level.lights.size());
    expect_near(plan.spawns[0].feet, {0, 0, -2});

    ASSERT_EQ(plan.lifts.size(), 1u);
    EXPECT_EQ(plan.lifts[0].top.y, 5.4);
    EXPECT_NEAR(plan.lifts[0].part.rest.m[7], 0.14, 1e-9);
    EXPECT_NEAR(plan.lifts[0].part.lower.y, -0.14, 1e-6);

    ASSERT_EQ(plan.gates.size(), 1u);
    expect_near(plan.exits[0], {25.6, 0, -16});
    for (const three_cores::Part& crate : plan.crates) {
        EXPECT_GE(crate.meshes.size(), 1u);
        EXPECT_LT(crate.lower.x, 0);
        EXPECT_GT(crate.upper.y, 0.5);
    }
}

} // namespace
} // namespace host::test
