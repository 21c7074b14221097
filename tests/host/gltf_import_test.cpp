#include <gtest/gtest.h>

#include "error.h"
#include "gltf/import.h"
#include "gltf_builder.h"

namespace host::test {
namespace {

Level import(const GltfBuilder& builder) {
    return gltf::import_bytes(builder.glb(), "test");
}

glm::vec3 winding_normal(const Mesh& mesh, size_t triangle) {
    const auto at = [&](size_t i) { return mesh.positions[mesh.indices[3 * triangle + i]]; };
    return glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
}

void expect_near(const glm::vec3& a, const glm::vec3& b) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-5f) << "component " << i;
}

TEST(GltfImport, ReadsAQuad) {
    const Level level = import(make_quad());
    ASSERT_EQ(level.meshes.size(), 1u);
    const Mesh& mesh = level.meshes[0];
    EXPECT_EQ(mesh.triangle_count(), 2u);
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.texcoords[0], glm::vec2(0, 1));
    EXPECT_EQ(mesh.materials[0], no_index);
    EXPECT_EQ(level.bounds.upper, glm::dvec3(1, 1, 0));
}

TEST(GltfImport, ReadsBuffersFromDataUris) {
    const std::string text = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],
        "scenes":[{"nodes":[0]}]})";
    const Level level = gltf::import_bytes(text, "test");
    ASSERT_EQ(level.triangle_count(), 1u);
    EXPECT_EQ(level.meshes[0].positions[1], glm::vec3(1, 0, 0));
}

TEST(GltfImport, BakesTheHierarchy) {
    GltfBuilder builder = make_quad();
    builder.json["nodes"][0]["scale"] = {2, 3, 4};
    builder.push("nodes", {{"children", {0}},
                           {"translation", {10, 0, 0}},
                           {"rotation", {0, 0.70710678, 0, 0.70710678}}});
    builder.push("nodes",
                 {{"children", {1}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1}}});
    builder.json["scenes"][0]["nodes"] = {2};
    const Level level = import(builder);
    const Mesh& mesh = level.meshes.at(0);
    // x turns to -z by the quarter turn about y.
    expect_near(mesh.positions[2], glm::vec3(10, 8, -2));
    expect_near(mesh.normals[0], glm::vec3(1, 0, 0));
    expect_near(winding_normal(mesh, 0), mesh.normals[0]);
}

TEST(GltfImport, MirroredNodesKeepTheirFrontFaces) {
    GltfBuilder builder = make_quad();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TANGENT"] = builder.add_accessor(
        std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 5126, "VEC4", 4);
    builder.json["nodes"][0]["scale"] = {-1, 1, 1};
    const Level level = import(builder);
    const Mesh& mesh = level.meshes.at(0);
    expect_near(winding_normal(mesh, 0), glm::vec3(0, 0, 1));
    expect_near(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.tangents[0], glm::vec4(-1, 0, 0, -1));
}

TEST(GltfImport, NormalsGoByTheInverseTranspose) {
    GltfBuilder builder = make_quad();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = builder.add_positions({1, 0, 1, 1, 0, 1, 1, 0, 1, 1, 0, 1});
    builder.json["nodes"][0]["scale"] = {2, 1, 1};
    expect_near(import(builder).meshes.at(0).normals[0],
                glm::normalize(glm::vec3(0.5f, 0.0f, 1.0f)));
}

//   1 --- 3 --- 5
//   | \   | \   |      a strip: 0 1 2, 2 1 3, 2 3 4, ...
//   |   \ |   \ |
//   0 --- 2 --- 4
TEST(GltfImport, StripsAndFansKeepOneWinding) {
    for (const int mode : {5, 6}) {
        GltfBuilder builder;
        const std::vector<float> strip = {0, 0, 0, 0, -1, 0, 1, 0, 0, 1, -1, 0, 2, 0, 0, 2, -1, 0};
        const std::vector<float> fan = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0, -1, 0, 0};
        const int positions = builder.add_positions(mode == 5 ? strip : fan);
        builder.show({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
        const Level level = import(builder);
        ASSERT_EQ(level.triangle_count(), 4u);
        for (size_t i = 0; i < 4; ++i)
            expect_near(winding_normal(level.meshes[0], i), glm::vec3(0, 0, 1));
    }
}

TEST(GltfImport, PointsAndLinesAreSkippedWithANote) {
    GltfBuilder builder = make_quad();
    builder.json["meshes"][0]["primitives"][0]["mode"] = 1;
    const Level level = import(builder);
    EXPECT_EQ(level.triangle_count(), 0u);
    EXPECT_EQ(level.notes.size(), 1u);
}

TEST(GltfImport, ReadsNormalisedIntegersAndStrides) {
    GltfBuilder builder = make_quad();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    // Two shorts and four bytes of something else, eight bytes apart.
    const int view = builder.add_view(
        std::vector<uint16_t>{0, 65535, 7, 7, 65535, 0, 7, 7, 13107, 0, 7, 7, 0, 0, 7, 7}, 8);
    attributes["TEXCOORD_0"] = builder.push("accessors", {{"bufferView", view},
                                                          {"componentType", 5123},
                                                          {"type", "VEC2"},
                                                          {"count", 4},
                                                          {"normalized", true}});
    attributes["NORMAL"] = builder.push(
        "accessors",
        {{"bufferView",
          builder.add_view(
              std::vector<int8_t>{0, 0, 127, 0, 0, 0, 127, 0, -128, 0, 0, 0, 0, 0, 127, 0}, 4)},
         {"componentType", 5120},
         {"type", "VEC3"},
         {"count", 4},
         {"normalized", true}});
    const Level level = import(builder);
    const Mesh& mesh = level.meshes.at(0);
    EXPECT_EQ(mesh.texcoords[0], glm::vec2(0, 1));
    EXPECT_NEAR(mesh.texcoords[2].x, 0.2f, 1e-6f);
    expect_near(mesh.normals[2], glm::vec3(-1, 0, 0));
}

TEST(GltfImport, ReadsEveryIndexType) {
    for (const int type : {5121, 5123, 5125}) {
        GltfBuilder builder = make_quad();
        const int indices =
            type == 5121 ? builder.add_accessor(std::vector<uint8_t>{2, 1, 0}, type, "SCALAR", 1)
            : type == 5123
                ? builder.add_accessor(std::vector<uint16_t>{2, 1, 0}, type, "SCALAR", 1)
                : builder.add_accessor(std::vector<uint32_t>{2, 1, 0}, type, "SCALAR", 1);
        builder.json["meshes"][0]["primitives"][0]["indices"] = indices;
        const Level level = import(builder);
        ASSERT_EQ(level.triangle_count(), 1u);
        expect_near(winding_normal(level.meshes[0], 0), glm::vec3(0, 0, -1));
    }
}

TEST(GltfImport, SparseAccessorsReplaceElementsOfZeros) {
    GltfBuilder builder = make_quad();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    const int indices = builder.add_view(std::vector<uint8_t>{1, 3});
    const int values = builder.add_view(std::vector<float>{5, 6, 7, 8, 9, 10});
    attributes["POSITION"] = builder.push(
        "accessors", {{"componentType", 5126},
                      {"type", "VEC3"},
                      {"count", 4},
                      {"sparse",
                       {{"count", 2},
                        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                        {"values", {{"bufferView", values}}}}}});
    const Level level = import(builder);
    const Mesh& mesh = level.meshes.at(0);
    EXPECT_EQ(mesh.positions[0], glm::vec3(0));
    EXPECT_EQ(mesh.positions[1], glm::vec3(5, 6, 7));
    EXPECT_EQ(mesh.positions[3], glm::vec3(8, 9, 10));
}

TEST(GltfImport, AppliesMorphWeightsAtRest) {
    GltfBuilder builder = make_quad();
    const int deltas = builder.add_positions({0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2});
    builder.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", deltas}}};
    builder.json["meshes"][0]["weights"] = {0.5};
    EXPECT_FLOAT_EQ(import(builder).meshes.at(0).positions[0].z, 1.0f);
    builder.json["nodes"][0]["weights"] = {0.25};
    EXPECT_FLOAT_EQ(import(builder).meshes.at(0).positions[0].z, 0.5f);
}

TEST(GltfImport, SkinsFollowTheirJointsAndNotTheirNode) {
    GltfBuilder builder = make_quad();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = builder.add_accessor(std::vector<uint8_t>(16, 0), 5121, "VEC4", 4);
    attributes["WEIGHTS_0"] = builder.add_accessor(
        std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5126, "VEC4", 4);
    const int joint = builder.push("nodes", {{"translation", {0, 3, 0}}});
    builder.json["skins"] = {{{"joints", {joint}}}};
    builder.json["nodes"][0]["skin"] = 0;
    builder.json["nodes"][0]["translation"] = {100, 0, 0};
    EXPECT_EQ(import(builder).meshes.at(0).positions[2], glm::vec3(1, 4, 0));
}

TEST(GltfImport, SharedVertexBuffersAreNotCopiedWhole) {
    GltfBuilder builder = make_quad();
    builder.json["meshes"][0]["primitives"][0]["indices"] =
        builder.add_accessor(std::vector<uint8_t>{3, 0, 2}, 5121, "SCALAR", 1);
    EXPECT_EQ(import(builder).meshes.at(0).positions.size(), 3u);
}

TEST(GltfImport, MergesANodesPrimitivesWithTheirMaterials) {
    GltfBuilder builder = make_quad();
    builder.json["materials"] = {{{"name", "a"}}, {{"name", "b"}}};
    Json& primitives = builder.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives[0]["material"] = 0;
    primitives[1]["material"] = 1;
    const Level level = import(builder);
    ASSERT_EQ(level.meshes.size(), 1u);
    EXPECT_EQ(level.meshes[0].materials, (std::vector<uint32_t>{0, 0, 1, 1}));
    EXPECT_EQ(level.meshes[0].positions.size(), 8u);
}

TEST(GltfImport, NormalsThatAreNoneBecomeTheFaces) {
    GltfBuilder builder = make_quad();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = builder.add_positions({0, 0, 0, nan, 0, 1, 0, 0, 1, 0, 0, 1});
    const Level level = import(builder);
    for (const glm::vec3& normal : level.meshes.at(0).normals)
        expect_near(normal, glm::vec3(0, 0, 1));
}

TEST(GltfImport, PositionsThatAreNoneDoNotSpoilTheBounds) {
    GltfBuilder builder = make_quad();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
        builder.add_positions({nan, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    EXPECT_EQ(import(builder).bounds.upper, glm::dvec3(1, 1, 0));
}

} // namespace
} // namespace host::test
