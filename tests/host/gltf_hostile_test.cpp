#include <random>

#include <gtest/gtest.h>

#include "error.h"
#include "gltf/import.h"
#include "gltf_builder.h"

// Damaged and malicious files: each is imported or refused with a sentence that names it.
namespace host::test {
namespace {

constexpr uint64_t huge = uint64_t{1} << 60;

// True if the bytes were refused.
bool refuses(const std::string& bytes) {
    try {
        gltf::import_bytes(bytes, "hostile.glb");
        return false;
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("hostile.glb"), std::string::npos);
        return true;
    }
}

std::string cause_of(const GltfBuilder& builder) {
    try {
        gltf::import_bytes(builder.glb(), "hostile.glb");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

// A quad that uses most of what a file can have.
GltfBuilder make_rich() {
    GltfBuilder builder = make_quad();
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["JOINTS_0"] =
        builder.add_accessor(std::vector<uint8_t>(16, 0), 5121, "VEC4", 4);
    primitive["attributes"]["WEIGHTS_0"] =
        builder.add_accessor(std::vector<float>(16, 0.25f), 5126, "VEC4", 4);
    const int indices = builder.add_view(std::vector<uint8_t>{1, 3});
    const int values = builder.add_view(std::vector<float>{5, 6, 7, 8, 9, 10});
    const int deltas = builder.push(
        "accessors", {{"componentType", 5126},
                      {"type", "VEC3"},
                      {"count", 4},
                      {"sparse",
                       {{"count", 2},
                        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                        {"values", {{"bufferView", values}}}}}});
    primitive["targets"] = {{{"POSITION", deltas}}};
    primitive["material"] = 0;
    builder.json["meshes"][0]["weights"] = {0.5};
    builder.json["images"] = {{{"bufferView", indices}, {"mimeType", "image/png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    builder.json["nodes"][0]["skin"] = 0;
    const int joint = builder.push(
        "nodes", {{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    builder.json["skins"] = {{{"joints", {joint}}}};
    builder.json["nodes"][0]["children"] = {joint};
    const int places = builder.add_positions({0, 0, 0, 1, 2, 3});
    const int turns =
        builder.add_accessor(std::vector<int8_t>{0, 0, 0, 127, 90, 0, 0, 90}, 5120, "VEC4", 4);
    builder.json["accessors"][static_cast<size_t>(turns)]["normalized"] = true;
    const Json attributes = {{"TRANSLATION", places}, {"ROTATION", turns}, {"SCALE", places}};
    builder.json["scenes"][0]["nodes"].push_back(builder.push(
        "nodes", {{"mesh", 0},
                  {"translation", {3000, 0, 1e6}},
                  {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}}));
    return builder;
}

TEST(GltfHostile, TheRichFileItselfIsSound) {
    EXPECT_FALSE(refuses(make_rich().glb()));
}

TEST(GltfHostile, EveryTruncationIsRefused) {
    const std::string glb = make_rich().glb();
    for (size_t size = 0; size < glb.size(); ++size)
        EXPECT_TRUE(refuses(glb.substr(0, size))) << size << " bytes";
}

TEST(GltfHostile, TruncationsThatAdmitItAreSurvived) {
    const std::string glb = make_rich().glb();
    for (uint32_t size = 20; size < glb.size(); ++size) {
        std::string cut = glb.substr(0, size);
        std::memcpy(cut.data() + 8, &size, 4);
        refuses(cut);
    }
}

TEST(GltfHostile, FlippedBitsAreSurvived) {
    const std::string glb = make_rich().glb();
    std::mt19937 random(20061);
    for (int round = 0; round < 20000; ++round) {
        std::string damaged = glb;
        for (uint32_t flips = 1 + random() % 4; flips > 0; --flips)
            damaged[random() % damaged.size()] ^= static_cast<char>(1u << random() % 8);
        refuses(damaged);
    }
}

TEST(GltfHostile, SwappedNumbersAreSurvived) {
    const Json sound = make_rich().json;
    const Json flat = sound.flatten();
    const Json poison[] = {-1,     1000000,       huge,           -2147483648LL, 1e308, 0.5,
                           "text", Json::array(), Json::object(), nullptr,       true,  0};
    for (const auto& [pointer, value] : flat.items())
        for (const Json& bad : poison) {
            GltfBuilder builder = make_rich();
            builder.json[Json::json_pointer(pointer)] = bad;
            refuses(builder.glb());
        }
}

TEST(GltfHostile, AccessorsBeyondTheirBuffer) {
    for (const uint64_t count : {uint64_t{5}, uint64_t{1} << 32, huge, ~uint64_t{0}}) {
        GltfBuilder builder = make_quad();
        builder.json["accessors"][0]["count"] = count;
        EXPECT_NE(cause_of(builder).find("accessor 0"), std::string::npos) << count;
    }
    GltfBuilder builder = make_quad();
    builder.json["accessors"][0]["byteOffset"] = huge;
    EXPECT_NE(cause_of(builder).find("accessor 0"), std::string::npos);
}

TEST(GltfHostile, ZerosWithoutABufferAreBounded) {
    GltfBuilder builder = make_quad();
    builder.json["accessors"][0].erase("bufferView");
    EXPECT_EQ(cause_of(builder), "");
    builder.json["accessors"][0]["count"] = huge;
    EXPECT_NE(cause_of(builder), "");
}

TEST(GltfHostile, BufferViewsBeyondTheirBuffer) {
    for (const char* key : {"byteOffset", "byteLength", "buffer"}) {
        GltfBuilder builder = make_quad();
        builder.json["bufferViews"][0][key] = 1000000;
        EXPECT_NE(cause_of(builder).find("buffer"), std::string::npos) << key;
    }
}

TEST(GltfHostile, IndicesOutOfRange) {
    GltfBuilder builder = make_quad();
    builder.json["meshes"][0]["primitives"][0]["indices"] =
        builder.add_accessor(std::vector<uint32_t>{0, 1, 4}, 5125, "SCALAR", 1);
    EXPECT_NE(cause_of(builder).find("index 4"), std::string::npos);
}

TEST(GltfHostile, CyclesAndSharedNodes) {
    GltfBuilder loop = make_quad();
    loop.json["nodes"][0]["children"] = {0};
    EXPECT_NE(cause_of(loop).find("cycle"), std::string::npos);

    GltfBuilder ring = make_quad();
    ring.push("nodes", {{"children", {2}}});
    ring.push("nodes", {{"children", {1}}});
    EXPECT_NE(cause_of(ring).find("cycle"), std::string::npos);

    GltfBuilder shared = make_quad();
    shared.push("nodes", {{"children", {0}}});
    shared.push("nodes", {{"children", {0}}});
    EXPECT_NE(cause_of(shared).find("two parents"), std::string::npos);
}

TEST(GltfHostile, AChainOfAHundredThousandNodes) {
    GltfBuilder builder = make_quad();
    for (int i = 0; i < 100000; ++i) builder.push("nodes", {{"children", {i}}});
    builder.json["scenes"][0]["nodes"] = {100000};
    EXPECT_EQ(cause_of(builder), "");
}

TEST(GltfHostile, DeepJsonIsRefused) {
    const std::string deep(1000000, '[');
    EXPECT_TRUE(refuses("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + deep));
    EXPECT_TRUE(refuses("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + deep
                        + std::string(1000000, ']') + "}"));
}

TEST(GltfHostile, ManyInstancesOfOneMeshAreBounded) {
    GltfBuilder builder;
    std::vector<uint8_t> indices(60000, 0);
    for (size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<uint8_t>(i % 3);
    const int positions = builder.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int index = builder.add_accessor(indices, 5121, "SCALAR", 1);
    builder.show({{"attributes", {{"POSITION", positions}}}, {"indices", index}});
    Json roots = {0};
    for (int i = 0; i < 20000; ++i) roots.push_back(builder.push("nodes", {{"mesh", 0}}));
    builder.json["scenes"][0]["nodes"] = roots;
    EXPECT_NE(cause_of(builder).find("more triangles"), std::string::npos);
}

TEST(GltfHostile, BuffersThatCopyOneAnother) {
    GltfBuilder builder = make_quad();
    builder.json["buffers"] = {{{"byteLength", 100}}, {{"byteLength", 100}}};
    EXPECT_NE(cause_of(builder), "");
    builder.json["buffers"] = {{{"byteLength", 100}, {"uri", "/dev/zero"}}};
    EXPECT_NE(cause_of(builder), "");
}

TEST(GltfHostile, RequiredExtensionsAreNamed) {
    GltfBuilder builder = make_quad();
    builder.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    EXPECT_NE(cause_of(builder).find("KHR_draco_mesh_compression"), std::string::npos);
    builder.json["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_texture_transform"};
    EXPECT_EQ(cause_of(builder), "");
}

TEST(GltfHostile, JointsThatTheSkinLacks) {
    GltfBuilder builder = make_rich();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] =
        builder.add_accessor(std::vector<uint8_t>(16, 9), 5121, "VEC4", 4);
    EXPECT_NE(cause_of(builder).find("joint 9"), std::string::npos);
}

TEST(GltfHostile, FilesThatAreNone) {
    EXPECT_TRUE(refuses(""));
    EXPECT_TRUE(refuses("glTF"));
    EXPECT_TRUE(refuses(std::string(4096, '\0')));
    EXPECT_TRUE(refuses("[]"));
    EXPECT_TRUE(refuses("{}"));
    EXPECT_THROW(gltf::import_file("/dev/zero"), InputError);
    EXPECT_THROW(gltf::import_file("/nonexistent/file.glb"), InputError);
}

} // namespace
} // namespace host::test
