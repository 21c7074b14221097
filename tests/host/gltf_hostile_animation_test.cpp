#include <random>

#include <gtest/gtest.h>

#include "animated_gltf.h"
#include "animation/pose.h"
#include "animation/skinning.h"
#include "error.h"
#include "gltf/import.h"

// Damaged animated files: each is refused with a sentence that names it, or plays.
namespace host::test {
namespace {

// All kinds of things that move.
GltfBuilder make_all() {
    GltfBuilder builder = make_strip();
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    const int deltas = builder.add_positions(std::vector<float>(18, 0.25f));
    primitive["targets"] = {{{"POSITION", deltas}, {"NORMAL", deltas}}};
    builder.json["meshes"][0]["weights"] = {0.5};
    Json rigid = primitive;
    rigid["attributes"].erase("JOINTS_0");
    const int mesh = builder.push("meshes", {{"primitives", {rigid}}});
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    const int door = builder.push(
        "nodes", {{"mesh", mesh}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const int twin = builder.push("nodes", {{"mesh", mesh}, {"children", {door}}});
    builder.json["scenes"][0]["nodes"].push_back(twin);
    add_channel(builder, twin, "translation", "CUBICSPLINE", {0, 1}, std::vector<float>(18, 0.5f),
                3);
    add_channel(builder, door, "scale", "STEP", {0, 1}, {1, 1, 1, 0, 0, 0}, 3);
    add_channel(builder, 0, "weights", "LINEAR", {0, 1}, {0, 1}, 1, 1);
    return builder;
}

// What the player does with a level.
void play(const Level& level) {
    Pose pose(level.rig);
    std::vector<glm::mat4x3> joints;
    Shape shape;
    for (const double time : {0.0, 0.4, 1e9}) {
        pose.set(time);
        for (const RigidMesh& rigid : level.rigid_meshes)
            for (const uint32_t node : rigid.nodes) ASSERT_EQ(pose.world(node), pose.world(node));
        for (const DeformingMesh& mesh : level.deforming_meshes) {
            joint_matrices(mesh, pose, joints);
            deform(mesh, joints, pose.weights(mesh.node), shape);
            ASSERT_EQ(shape.positions.size(), mesh.vertex_count());
        }
    }
}

bool refuses(const std::string& bytes) {
    Level level;
    try {
        level = gltf::import_bytes(bytes, "hostile.glb", "");
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("hostile.glb"), std::string::npos);
        return true;
    }
    play(level);
    return false;
}

TEST(GltfHostileAnimation, TheFileItselfIsSound) {
    const Level level = gltf::import_bytes(make_all().glb(), "all", "");
    EXPECT_TRUE(level.notes.empty());
    EXPECT_EQ(level.rigid_meshes.size(), 1u);
    EXPECT_EQ(level.rigid_meshes[0].nodes.size(), 2u);
    EXPECT_EQ(level.deforming_meshes.size(), 1u);
    EXPECT_NE(level.lights.at(0).node, no_index);
    play(level);
}

TEST(GltfHostileAnimation, FlippedBitsAreSurvived) {
    const std::string glb = make_all().glb();
    std::mt19937 random(20141);
    size_t played = 0;
    for (int round = 0; round < 5000; ++round) {
        std::string damaged = glb;
        for (uint32_t flips = 1 + random() % 4; flips > 0; --flips)
            damaged[random() % damaged.size()] ^= static_cast<char>(1u << random() % 8);
        played += refuses(damaged) ? 0 : 1;
    }
    EXPECT_GT(played, 500u);
}

TEST(GltfHostileAnimation, SwappedNumbersAreSurvived) {
    const Json flat = make_all().json.flatten();
    const Json poison[] = {-1,     1000000,       uint64_t{1} << 60, -2147483648LL, 1e308, 0.5,
                           "text", Json::array(), Json::object(),    nullptr,       true,  0};
    for (const auto& [pointer, value] : flat.items())
        for (const Json& bad : poison) {
            GltfBuilder builder = make_all();
            builder.json[Json::json_pointer(pointer)] = bad;
            refuses(builder.glb());
        }
}

TEST(GltfHostileAnimation, ManyChannelsThatShareTheirKeysAreBounded) {
    GltfBuilder builder = make_quad();
    std::vector<float> times(20000);
    for (size_t i = 0; i < times.size(); ++i) times[i] = static_cast<float>(i);
    const int input = builder.add_accessor(times, 5126, "SCALAR", 1);
    const int output = builder.push(
        "accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", times.size()}});
    Json nodes = {0}, channels;
    for (int i = 0; i < 2000; ++i) {
        const int node = builder.push("nodes", Json::object());
        channels.push_back({{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}});
    }
    builder.json["animations"] = {
        {{"channels", channels}, {"samplers", {{{"input", input}, {"output", output}}}}}};
    EXPECT_TRUE(refuses(builder.glb()));
}

TEST(GltfHostileAnimation, TargetsThatShareTheirDeltasAreBounded) {
    GltfBuilder builder = make_strip();
    const int deltas =
        builder.push("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 6}});
    Json targets;
    for (int i = 0; i < 30000; ++i) targets.push_back({{"POSITION", deltas}});
    builder.json["meshes"][0]["primitives"][0]["targets"] = targets;
    for (int i = 0; i < 20; ++i)
        builder.json["scenes"][0]["nodes"].push_back(
            builder.push("nodes", {{"mesh", 0}, {"skin", 0}}));
    EXPECT_TRUE(refuses(builder.glb()));
}

TEST(GltfHostileAnimation, JointsOutOfRange) {
    GltfBuilder node = make_strip();
    node.json["skins"][0]["joints"] = {1, 99};
    EXPECT_TRUE(refuses(node.glb()));
    GltfBuilder vertex = make_strip();
    vertex.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] =
        vertex.add_accessor(std::vector<uint8_t>(24, 2), 5121, "VEC4", 4);
    EXPECT_TRUE(refuses(vertex.glb()));
    GltfBuilder matrices = make_strip();
    const auto binds = matrices.json["skins"][0]["inverseBindMatrices"].get<size_t>();
    matrices.json["accessors"][binds]["count"] = 1;
    EXPECT_TRUE(refuses(matrices.glb()));
}

TEST(GltfHostileAnimation, AnimatedCyclesAreRefused) {
    GltfBuilder builder = make_door();
    builder.json["nodes"][0]["children"] = {1};
    EXPECT_TRUE(refuses(builder.glb()));
}

} // namespace
} // namespace host::test
