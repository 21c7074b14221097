#include <gtest/gtest.h>

#include "animated_gltf.h"
#include "animation/pose.h"
#include "animation/skinning.h"
#include "error.h"
#include "gltf/import.h"

// From a file's keys to poses and shapes at a time, against values worked out by hand.
namespace host::test {
namespace {

Level import(const GltfBuilder& builder, const std::string& animation = "") {
    return gltf::import_bytes(builder.glb(), "test", animation);
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-6) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

// Where a point of a rigid mesh is at a time.
glm::dvec3 rigid_at(const Level& level, double time, const glm::dvec3& point, size_t instance = 0) {
    Pose pose(level.rig);
    pose.set(time);
    const uint32_t node = level.rigid_meshes.at(0).nodes.at(instance);
    return glm::dvec3(pose.world(node) * glm::dvec4(point, 1.0));
}

Shape shape_at(const Level& level, double time) {
    Pose pose(level.rig);
    pose.set(time);
    const DeformingMesh& mesh = level.deforming_meshes.at(0);
    std::vector<glm::mat4x3> joints;
    joint_matrices(mesh, pose, joints);
    Shape shape;
    deform(mesh, joints, pose.weights(mesh.node), shape);
    return shape;
}

bool has_note(const Level& level, const std::string& part) {
    for (const std::string& note : level.notes)
        if (note.find(part) != std::string::npos) return true;
    return false;
}

TEST(Animation, LinearRotationsTakeTheArc) {
    const Level level = import(make_door());
    EXPECT_EQ(level.meshes.size(), 0u);
    ASSERT_EQ(level.rigid_meshes.size(), 1u);
    const double root = std::sqrt(0.5);
    expect_near(rigid_at(level, 0.0, {1, 1, 0}), {11, 1, 0});
    expect_near(rigid_at(level, 1.0, {1, 1, 0}), {10 + root, 1, -root});
    expect_near(rigid_at(level, 1.5, {1, 0, 0}),
                {10 + std::cos(1.1780972450961724), 0, -std::sin(1.1780972450961724)});
}

TEST(Animation, ClipsLoop) {
    const Level level = import(make_door());
    expect_near(rigid_at(level, 3.0, {1, 0, 0}), rigid_at(level, 1.0, {1, 0, 0}));
    expect_near(rigid_at(level, 2.0, {1, 0, 0}), {11, 0, 0}); // the end is the beginning
    expect_near(rigid_at(level, 1.999999, {1, 0, 0}), {10, 0, -1}, 1e-5);
}

TEST(Animation, TheShorterWayRound) {
    GltfBuilder builder = make_quad(); // the same quarter turn, with the other sign
    add_channel(builder, 0, "rotation", "LINEAR", {0, 2},
                {0, 0, 0, 1, 0, -half_root, 0, -half_root}, 4);
    const double root = std::sqrt(0.5);
    expect_near(rigid_at(import(builder), 1.0, {1, 0, 0}), {root, 0, -root});
}

TEST(Animation, StepsHoldUntilTheNextKey) {
    GltfBuilder builder = make_quad();
    add_channel(builder, 0, "translation", "STEP", {0.5, 1, 2}, {0, 1, 0, 0, 3, 0, 0, 5, 0}, 3);
    const Level level = import(builder);
    expect_near(rigid_at(level, 0.0, {0, 0, 0}), {0, 1, 0}); // before the first key: its value
    expect_near(rigid_at(level, 0.999, {0, 0, 0}), {0, 1, 0});
    expect_near(rigid_at(level, 1.0, {0, 0, 0}), {0, 3, 0});
    expect_near(rigid_at(level, 1.999, {0, 0, 0}), {0, 3, 0});
}

// h00 0 + h10 2 4 + h01 2 + h11 2 (-1) with h00 = h01 = 1/2, h10 = -h11 = 1/8 at the middle.
TEST(Animation, CubicSplinesUseTheirTangents) {
    GltfBuilder builder = make_quad();
    add_channel(builder, 0, "translation", "CUBICSPLINE", {0, 2},
                {9, 9, 9, 0, 0, 0, 4, 0, 0, /**/ -1, 0, 0, 2, 0, 0, 9, 9, 9}, 3);
    const Level level = import(builder);
    expect_near(rigid_at(level, 0.0, {0, 0, 0}), {0, 0, 0});
    expect_near(rigid_at(level, 1.0, {0, 0, 0}), {0.125 * 8 + 1 + 0.125 * 2, 0, 0});
    expect_near(rigid_at(level, 0.5, {0, 0, 0}), {0.140625 * 8 + 0.15625 * 2 + 0.046875 * 2, 0, 0});
}

TEST(Animation, CubicRotationsStayOfUnitLength) {
    GltfBuilder builder = make_quad();
    add_channel(builder, 0, "rotation", "CUBICSPLINE", {0, 1},
                {0, 0, 0, 0, 0, 0, 0, 1, 0, 3, 0, 0, //
                 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0},
                4);
    const Level level = import(builder);
    for (const double time : {0.1, 0.5, 0.9})
        EXPECT_NEAR(glm::length(rigid_at(level, time, {1, 0, 0})), 1.0, 1e-9) << time;
}

TEST(Animation, ScalesAndChildrenFollow) {
    GltfBuilder builder = make_quad(); // node 0, below 1, below 2 which grows
    builder.push("nodes", {{"children", {0}}, {"translation", {1, 0, 0}}});
    builder.push("nodes", {{"children", {1}}});
    builder.json["scenes"][0]["nodes"] = {2};
    add_channel(builder, 2, "scale", "LINEAR", {0, 1}, {1, 1, 1, 3, 1, 1}, 3);
    const Level level = import(builder);
    expect_near(rigid_at(level, 0.5, {1, 1, 0}), {4, 1, 0});
}

TEST(Animation, NormalisedKeysAreRead) {
    GltfBuilder builder = make_door();
    Json& output = builder.json["animations"][0]["samplers"][0]["output"];
    output = builder.add_accessor(std::vector<int16_t>{0, 0, 0, 32767, 0, 23170, 0, 23170}, 5122,
                                  "VEC4", 4);
    builder.json["accessors"][output.get<size_t>()]["normalized"] = true;
    const double root = std::sqrt(0.5);
    expect_near(rigid_at(import(builder), 1.0, {1, 0, 0}), {10 + root, 0, -root}, 1e-4);
}

TEST(Animation, AMeshAtSeveralMovingNodesIsStoredOnce) {
    GltfBuilder builder = make_quad();
    builder.push("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
    builder.push("nodes", {{"mesh", 0}});
    builder.json["scenes"][0]["nodes"] = {0, 1, 2};
    for (const int node : {0, 1})
        add_channel(builder, node, "translation", "LINEAR", {0, 1},
                    {5.0f * static_cast<float>(node), 0, 0, 0, 2, 0}, 3);
    const Level level = import(builder);
    ASSERT_EQ(level.rigid_meshes.size(), 1u);
    EXPECT_EQ(level.rigid_meshes[0].nodes.size(), 2u);
    EXPECT_EQ(level.meshes.size(), 1u); // node 2 stands still
    EXPECT_EQ(level.triangle_count(), 6u);
    EXPECT_EQ(level.bounds.upper.x, 6.0);
    expect_near(rigid_at(level, 0.5, {0, 0, 0}, 1), {2.5, 1, 0});
}

TEST(Animation, TheStripBends) {
    const Level level = import(make_strip());
    ASSERT_EQ(level.deforming_meshes.size(), 1u);
    EXPECT_EQ(level.meshes.size(), 0u);
    EXPECT_EQ(level.bounds.upper, glm::dvec3(2, 11, 0));
    const Shape rest = shape_at(level, 0.0);
    expect_near(rest.positions[5], {2, 11, 0});
    const Shape bent = shape_at(level, 1.9999999);
    const glm::dvec3 expected[] = {{0, 10, 0},     {0, 11, 0}, {1, 10, 0},
                                   {0.5, 10.5, 0}, {1, 11, 0}, {0, 11, 0}};
    for (size_t i = 0; i < 6; ++i) {
        SCOPED_TRACE(i);
        expect_near(bent.positions[i], expected[i], 1e-5);
        expect_near(bent.normals[i], {0, 0, 1});
    }
}

TEST(Animation, EveryTypeOfJointsAndWeights) {
    for (const int joints : {5121, 5123})
        for (const int weights : {5121, 5123, 5126}) {
            const Level level = import(make_strip(joints, weights));
            SCOPED_TRACE(std::to_string(joints) + " " + std::to_string(weights));
            expect_near(shape_at(level, 1.9999999).positions[3], {0.5, 10.5, 0}, 1e-5);
        }
}

TEST(Animation, VerticesWithoutWeightsStay) {
    GltfBuilder builder = make_strip();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] = builder.add_accessor(std::vector<float>(24, 0.0f), 5126, "VEC4", 4);
    const Level level = import(builder);
    expect_near(shape_at(level, 1.5).positions[5], {2, 1, 0});
}

TEST(Animation, SkinsAtRestAreBakedAsWithoutAnimation) {
    GltfBuilder builder = make_strip();
    builder.json["animations"][0]["channels"][0]["target"]["node"] = 0; // not a joint
    const Level level = import(builder);
    EXPECT_EQ(level.deforming_meshes.size(), 0u);
    EXPECT_EQ(level.meshes.at(0).positions, import(make_strip(), "none").meshes.at(0).positions);
}

TEST(Animation, MorphTargetsFollowTheirWeights) {
    GltfBuilder builder = make_quad();
    const int up = builder.add_positions({0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2});
    const int right = builder.add_positions({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    builder.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", up}},
                                                             {{"POSITION", right}}};
    builder.json["meshes"][0]["weights"] = {0.5, 0};
    builder.json["nodes"][0]["translation"] = {0, 7, 0};
    add_channel(builder, 0, "weights", "LINEAR", {0, 2}, {0, 0, 1, 0.5}, 1);
    const Level level = import(builder);
    ASSERT_EQ(level.deforming_meshes.size(), 1u);
    EXPECT_EQ(level.bounds.upper.z, 1.0);
    expect_near(shape_at(level, 1.0).positions[0], {0.25, 7, 1});
    expect_near(shape_at(level, 1.0).positions[2], {1, 8, 1});
}

TEST(Animation, MirroredSkinsKeepTheirFrontFaces) {
    GltfBuilder builder = make_strip();
    builder.json["nodes"][3]["scale"] = {-1, 1, 1};
    const Level level = import(builder);
    const Shape shape = shape_at(level, 0.0);
    const Mesh& mesh = level.deforming_meshes[0].mesh;
    const auto at = [&](size_t i) { return shape.positions[mesh.indices[i]]; };
    EXPECT_GT(glm::cross(at(1) - at(0), at(2) - at(0)).z, 0.0f);
    expect_near(shape.normals[0], {0, 0, 1});
}

TEST(Animation, LightsAndCamerasNameTheirNodes) {
    GltfBuilder builder = make_door();
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    builder.push("nodes",
                 {{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    builder.json["nodes"][0]["children"] = {2};
    const Level level = import(builder);
    EXPECT_NE(level.lights.at(0).node, no_index);
    EXPECT_NE(level.cameras.at(0).node, no_index);
    EXPECT_EQ(import(builder, "none").lights.at(0).node, no_index);
}

TEST(Animation, ClipsAreChosenByNameOrIndex) {
    GltfBuilder builder = make_door();
    add_channel(builder, 0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 4, 0}, 3, 1);
    builder.json["animations"][0]["name"] = "open";
    builder.json["animations"][1]["name"] = "rise";
    EXPECT_EQ(import(builder).rig.clips.size(), 2u);
    expect_near(rigid_at(import(builder, "rise"), 0.5, {1, 0, 0}), {11, 2, 0});
    expect_near(rigid_at(import(builder, "1"), 0.5, {1, 0, 0}), {11, 2, 0});
    EXPECT_EQ(import(builder, "none").rigid_meshes.size(), 0u);
    for (const char* bad : {"2", "-1", "ope", "1x"}) {
        try {
            import(builder, bad);
            ADD_FAILURE() << bad;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("0 open, 1 rise"), std::string::npos);
        }
    }
}

TEST(Animation, OfTwoThatDriveOneNodeTheFirstPlays) {
    GltfBuilder builder = make_door();
    add_channel(builder, 0, "rotation", "STEP", {0}, {1, 0, 0, 0}, 4, 1);
    const Level level = import(builder);
    EXPECT_EQ(level.rig.clips.size(), 1u);
    EXPECT_TRUE(has_note(level, "the first one does"));
}

// Each damage leaves the animation out, with a note that says why, and the door standing.
TEST(Animation, BrokenChannelsAreLeftOutWithANote) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto damage = [](const char* because, auto&& change) {
        SCOPED_TRACE(because);
        GltfBuilder builder = make_door();
        change(builder, builder.json["animations"][0]["samplers"][0],
               builder.json["animations"][0]["channels"][0]);
        const Level level = import(builder);
        EXPECT_TRUE(has_note(level, because));
        EXPECT_EQ(level.rig.clips.size(), 0u);
        EXPECT_EQ(level.meshes.size(), 1u);
    };
    const auto with_times = [](std::vector<float> times) {
        return [times](GltfBuilder& builder, Json& sampler, Json&) {
            sampler["input"] = builder.add_accessor(times, 5126, "SCALAR", 1);
        };
    };
    damage("do not ascend", with_times({0, nan}));
    damage("do not ascend", with_times({2, 1}));
    damage("do not ascend", with_times({-1, 1}));
    damage("do not ascend", with_times({0, INFINITY}));
    damage("a value for every key", with_times({0, 1, 2}));
    damage("accessor 99 is named but does not exist",
           [](GltfBuilder&, Json& sampler, Json&) { sampler["input"] = 99; });
    damage("accessor 99 is named but does not exist",
           [](GltfBuilder&, Json& sampler, Json&) { sampler["output"] = 99; });
    damage("holds no key times", [](GltfBuilder&, Json& sampler, Json&) { sampler["input"] = 0; });
    damage("is unknown",
           [](GltfBuilder&, Json& sampler, Json&) { sampler["interpolation"] = "WAVY"; });
    damage("its sampler does not exist",
           [](GltfBuilder&, Json&, Json& channel) { channel["sampler"] = 7; });
    damage("node 99", [](GltfBuilder&, Json&, Json& channel) { channel["target"]["node"] = 99; });
    damage("it drives no node's",
           [](GltfBuilder&, Json&, Json& channel) { channel["target"]["path"] = "colour"; });
    damage("has a matrix", [](GltfBuilder& builder, Json&, Json&) {
        builder.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    });
    damage("not finite", [&](GltfBuilder& builder, Json& sampler, Json&) {
        sampler["output"] =
            builder.add_accessor(std::vector<float>{0, 0, 0, 1, 0, nan, 0, 1}, 5126, "VEC4", 4);
    });
}

// ... but count for how long the clip is.
TEST(Animation, KeysThatHoldTheRestPoseMoveNothing) {
    GltfBuilder builder = make_door();
    builder.push("nodes", {{"mesh", 0}, {"translation", {3, 0, 0}}});
    builder.json["scenes"][0]["nodes"] = {1, 2};
    add_channel(builder, 2, "translation", "LINEAR", {0, 4}, {3, 0, 0, 3, 0, 0}, 3);
    add_channel(builder, 2, "scale", "STEP", {0}, {1, 1, 1}, 3);
    const Level level = import(builder);
    EXPECT_EQ(level.meshes.size(), 1u);
    EXPECT_EQ(level.rig.clips.at(0).tracks.size(), 1u);
    EXPECT_EQ(level.rig.clips.at(0).duration, 4.0);
}

TEST(Animation, ZeroQuaternionsTurnNothing) {
    GltfBuilder builder = make_door();
    builder.json["animations"][0]["samplers"][0]["output"] =
        builder.add_accessor(std::vector<float>(8, 0.0f), 5126, "VEC4", 4);
    expect_near(rigid_at(import(builder), 1.0, {1, 0, 0}), {11, 0, 0});
}

TEST(Animation, TheMillHasOneOfEachKind) {
    const Level level = gltf::import_file(PEREGRINE_SOURCE_DIR "/content/mill.glb", "");
    EXPECT_TRUE(level.notes.empty());
    EXPECT_EQ(level.rig.clips.size(), 7u);
    EXPECT_EQ(level.deforming_meshes.size(), 2u); // the flag and the pond
    size_t sails = 0;
    for (const RigidMesh& rigid : level.rigid_meshes)
        if (rigid.mesh.name == "sail_0") sails = rigid.nodes.size();
    EXPECT_EQ(sails, 4u);
    EXPECT_NE(level.cameras.at(2).node, no_index);
    EXPECT_EQ(level.cameras.at(0).node, no_index);
}

} // namespace
} // namespace host::test
