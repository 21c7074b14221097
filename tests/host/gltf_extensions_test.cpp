#include <cmath>

#include <gtest/gtest.h>

#include "animated_gltf.h"
#include "animation/pose.h"
#include "error.h"
#include "gltf/import.h"

// Extensions: what is refused, what is noted, and instances.
namespace host::test {
namespace {

Level import(const GltfBuilder& builder, const std::string& animation = gltf::no_animation) {
    return gltf::import_bytes(builder.glb(), "test", animation);
}

std::string cause_of(const GltfBuilder& builder) {
    try {
        import(builder);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

size_t count_notes(const Level& level, const std::string& part) {
    size_t count = 0;
    for (const std::string& note : level.notes)
        count += note.find(part) == std::string::npos ? 0 : 1;
    return count;
}

constexpr const char* ignored[] = {"KHR_materials_pbrSpecularGlossiness",
                                   "KHR_materials_clearcoat",
                                   "KHR_materials_sheen",
                                   "KHR_materials_iridescence",
                                   "KHR_materials_anisotropy",
                                   "VENDOR_materials_unheard_of"};

TEST(GltfExtensions, WhatIsIgnoredIsNotedOnce) {
    GltfBuilder builder = make_quad();
    for (const char* name : ignored) {
        const Json material = {{"extensions", {{name, {{"anyFactor", 0.5}}}}}};
        builder.push("materials", material);
        builder.push("materials", material);
    }
    builder.json["nodes"][0]["extensions"]["MSFT_lod"] = {{"ids", Json::array()}};
    builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"] = {
        {"mappings", Json::array()}};
    builder.json["extensionsUsed"] = {"KHR_materials_sheen", "EXT_only_declared"};
    const Level level = import(builder);
    for (const char* name : ignored) EXPECT_EQ(count_notes(level, name), 1u) << name;
    for (const char* name : {"MSFT_lod", "KHR_materials_variants", "EXT_only_declared"})
        EXPECT_EQ(count_notes(level, name), 1u) << name;
    EXPECT_EQ(level.notes.size(), std::size(ignored) + 3);
}

TEST(GltfExtensions, WhatIsSupportedOrNobodysIsNotNoted) {
    GltfBuilder builder = make_quad();
    builder.json["extensionsUsed"] = {"KHR_materials_unlit", "KHR_texture_transform",
                                      "EXT_mesh_gpu_instancing"};
    builder.push("materials", {{"extensions", {{"KHR_materials_unlit", Json::object()}}}});
    builder.json["extras"] = {{"extensions", {{"KHR_materials_sheen", 1}}}};
    EXPECT_TRUE(import(builder).notes.empty());
}

TEST(GltfExtensions, AllThatIsRequiredAndLackingIsNamed) {
    GltfBuilder builder = make_quad();
    builder.json["extensionsRequired"] = {"KHR_texture_basisu", "KHR_texture_transform",
                                          "EXT_meshopt_compression"};
    const std::string cause = cause_of(builder);
    EXPECT_NE(cause.find("KHR_texture_basisu"), std::string::npos) << cause;
    EXPECT_NE(cause.find("EXT_meshopt_compression"), std::string::npos) << cause;
    EXPECT_EQ(cause.find("KHR_texture_transform"), std::string::npos) << cause;
    builder.json["extensionsRequired"] = {std::string(100000, 'x') + "\n"};
    EXPECT_LT(cause_of(builder).size(), 300u);
}

// What is required is named before what is broken for lack of it.
TEST(GltfExtensions, RequiredOnesAreNamedFirst) {
    GltfBuilder builder = make_quad();
    builder.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    builder.json["buffers"] = {{{"byteLength", 4}, {"uri", "missing.bin"}}};
    EXPECT_NE(cause_of(builder).find("KHR_draco"), std::string::npos);
}

Json& instance(GltfBuilder& builder, const Json& attributes) {
    builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    builder.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    Json& extension = builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"];
    extension = {{"attributes", attributes}};
    return extension["attributes"];
}

void expect_at(const glm::dmat4& place, const glm::dvec3& point, const glm::dvec3& expected) {
    const glm::dvec3 found(place * glm::dvec4(point, 1.0));
    EXPECT_LT(glm::length(found - expected), 1e-4) << found.x << " " << found.y << " " << found.z;
}

TEST(GltfInstancing, TransformsAreRelativeToTheNode) {
    GltfBuilder builder = make_quad();
    builder.json["nodes"][0]["translation"] = {100, 0, 0};
    builder.json["nodes"][0]["scale"] = {2, 2, 2};
    instance(builder, {{"TRANSLATION", builder.add_positions({0, 0, 0, 1, 2, 3})},
                       {"ROTATION", builder.add_accessor(
                                        std::vector<float>{0, 0, 0, 1, 0, 0, half_root, half_root},
                                        5126, "VEC4", 4)},
                       {"SCALE", builder.add_positions({1, 1, 1, 3, 3, 3})}});
    const Level level = import(builder);
    EXPECT_TRUE(level.meshes.empty());
    ASSERT_EQ(level.rigid_meshes.size(), 1u);
    const RigidMesh& rigid = level.rigid_meshes[0];
    EXPECT_TRUE(rigid.nodes.empty());
    ASSERT_EQ(rigid.places.size(), 2u);
    expect_at(rigid.places[0], {1, 0, 0}, {102, 0, 0});
    expect_at(rigid.places[1], {1, 0, 0}, {102, 10, 6}); // 2 ((1, 2, 3) + 3 (0, 1, 0))
    EXPECT_EQ(level.triangle_count(), 4u);
    EXPECT_NEAR(level.bounds.upper.x, 102.0, 1e-4);
    EXPECT_NEAR(level.bounds.lower.x, 96.0, 1e-4);
    EXPECT_NEAR(level.bounds.upper.y, 10.0, 1e-4);
    EXPECT_TRUE(level.notes.empty());
}

TEST(GltfInstancing, RotationsMayBeNormalizedIntegers) {
    const auto check = [](const auto& values, int type) {
        GltfBuilder builder = make_quad();
        const int rotation = builder.add_accessor(values, type, "VEC4", 4);
        builder.json["accessors"][static_cast<size_t>(rotation)]["normalized"] = true;
        instance(builder, {{"ROTATION", rotation}});
        const Level level = import(builder);
        ASSERT_EQ(level.rigid_meshes.at(0).places.size(), 1u);
        expect_at(level.rigid_meshes[0].places[0], {1, 0, 0}, {0, 1, 0});
    };
    check(std::vector<int8_t>{0, 0, 90, 90}, 5120);
    check(std::vector<int16_t>{0, 0, 23170, 23170}, 5122);
}

TEST(GltfInstancing, AttributesMayBeSparse) {
    GltfBuilder builder = make_quad();
    const int indices = builder.add_view(std::vector<uint8_t>{1});
    const int values = builder.add_view(std::vector<float>{7, 8, 9});
    instance(builder,
             {{"TRANSLATION",
               builder.push("accessors",
                            {{"componentType", 5126},
                             {"type", "VEC3"},
                             {"count", 3},
                             {"sparse",
                              {{"count", 1},
                               {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                               {"values", {{"bufferView", values}}}}}})}});
    const auto places = import(builder).rigid_meshes.at(0).places;
    ASSERT_EQ(places.size(), 3u);
    expect_at(places[0], {0, 0, 0}, {0, 0, 0});
    expect_at(places[1], {0, 0, 0}, {7, 8, 9});
}

TEST(GltfInstancing, InstancesFollowANodeThatMoves) {
    GltfBuilder builder = make_quad();
    instance(builder, {{"TRANSLATION", builder.add_positions({0, 0, 0, 0, 5, 0})}});
    add_channel(builder, 0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 4, 0, 0}, 3);
    const Level level = import(builder, "");
    const RigidMesh& rigid = level.rigid_meshes.at(0);
    EXPECT_TRUE(rigid.places.empty());
    ASSERT_EQ(rigid.nodes.size(), 2u);
    Pose pose(level.rig);
    pose.set(0.5);
    expect_at(pose.world(rigid.nodes[0]), {0, 0, 0}, {2, 0, 0});
    expect_at(pose.world(rigid.nodes[1]), {0, 0, 0}, {2, 5, 0});
}

TEST(GltfInstancing, NodesShareTheMesh) {
    GltfBuilder builder = make_quad();
    instance(builder, {{"TRANSLATION", builder.add_positions({0, 0, 0, 0, 5, 0})}});
    Json second = builder.json["nodes"][0];
    second["translation"] = {0, 0, 50};
    builder.json["scenes"][0]["nodes"].push_back(builder.push("nodes", second));
    builder.json["scenes"][0]["nodes"].push_back(builder.push("nodes", {{"mesh", 0}}));
    const Level level = import(builder);
    ASSERT_EQ(level.rigid_meshes.size(), 1u);
    EXPECT_EQ(level.rigid_meshes[0].places.size(), 4u);
    EXPECT_EQ(level.meshes.size(), 1u); // the node that has the mesh once
}

TEST(GltfInstancing, MeshesThatDeformAreDrawnOnce) {
    GltfBuilder builder = make_strip();
    instance(builder, {{"TRANSLATION", builder.add_positions({0, 0, 0, 0, 5, 0})}});
    for (const char* animation : {"", gltf::no_animation}) {
        const Level level = import(builder, animation);
        EXPECT_EQ(level.triangle_count(), 4u);
        EXPECT_EQ(count_notes(level, "drawn once"), 1u);
    }
}

TEST(GltfInstancing, PlacesThatAreNotFiniteAreLeftOut) {
    GltfBuilder builder = make_quad();
    instance(builder,
             {{"TRANSLATION", builder.add_positions({NAN, 0, 0, 0, 5, 0, 0, INFINITY, 0})}});
    const Level level = import(builder);
    EXPECT_EQ(level.rigid_meshes.at(0).places.size(), 1u);
    EXPECT_EQ(count_notes(level, "not finite"), 1u);
}

TEST(GltfInstancing, AttributesThatDisagreeAreRefused) {
    GltfBuilder builder = make_quad();
    const int two = builder.add_positions({0, 0, 0, 0, 5, 0}),
              one = builder.add_positions({1, 1, 1});
    Json& attributes = instance(builder, {{"TRANSLATION", two}, {"SCALE", one}});
    std::string cause = cause_of(builder);
    EXPECT_NE(cause.find("have 2 and 1 elements"), std::string::npos) << cause;
    attributes = {{"ROTATION", two}};
    cause = cause_of(builder);
    EXPECT_NE(cause.find("ROTATION of EXT_mesh_gpu_instancing"), std::string::npos) << cause;
    for (const Json& bad : {Json(99), Json(-1), Json(0.5), Json("0"), Json(nullptr)}) {
        attributes = {{"TRANSLATION", bad}};
        EXPECT_NE(cause_of(builder), "") << bad;
    }
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = Json::object();
    EXPECT_NE(cause_of(builder).find("no attributes"), std::string::npos);
}

TEST(GltfInstancing, AttributesOfTheAuthorsAloneChangeNothing) {
    GltfBuilder builder = make_quad();
    instance(builder, {{"_ID", builder.add_accessor(std::vector<float>{1, 2}, 5126, "SCALAR", 1)}});
    EXPECT_EQ(import(builder).triangle_count(), 2u);
}

// Zeros without bytes behind them, and many nodes that name the same instances.
TEST(GltfInstancing, CountsAreBoundedByWhatTheFileHolds) {
    GltfBuilder zeros = make_quad();
    Json accessor = {{"componentType", 5126}, {"type", "VEC3"}, {"count", uint64_t{1} << 40}};
    Json& attributes = instance(zeros, {{"TRANSLATION", zeros.push("accessors", accessor)}});
    EXPECT_NE(cause_of(zeros).find("more elements"), std::string::npos);
    zeros.json["extras"] = std::string(1 << 20, 'x');
    accessor["count"] = 1 << 20;
    attributes["TRANSLATION"] = zeros.push("accessors", accessor);
    EXPECT_NE(cause_of(zeros).find("than a file of its size may"), std::string::npos);

    GltfBuilder shared = make_quad();
    instance(shared, {{"TRANSLATION", shared.add_positions(std::vector<float>(30000, 1.0f))}});
    const Json node = shared.json["nodes"][0];
    for (int i = 0; i < 1000; ++i)
        shared.json["scenes"][0]["nodes"].push_back(shared.push("nodes", node));
    EXPECT_NE(cause_of(shared).find("than a file of its size may"), std::string::npos);
}

// A forest is far more triangles than bytes.
TEST(GltfInstancing, ManyInstancesOfALargeMeshAreFine) {
    GltfBuilder builder;
    std::vector<float> positions;
    for (int i = 0; i < 3000; ++i)
        positions.insert(positions.end(), {static_cast<float>(i % 3), static_cast<float>(i), 0});
    builder.show({{"attributes", {{"POSITION", builder.add_positions(positions)}}}});
    instance(builder, {{"TRANSLATION", builder.add_positions(std::vector<float>(60000, 1.0f))}});
    EXPECT_EQ(cause_of(builder), "");
    EXPECT_EQ(import(builder).triangle_count(), 20000000u);
}

} // namespace
} // namespace host::test
