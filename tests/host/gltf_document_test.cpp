#include "scene_folder.h"

// What a document says of itself: numbers, versions and images, and what is said of those that
// cannot be used.
namespace host::test {
namespace {

using GltfDocument = SceneFolder;

// An accessor without a buffer view is all zeros but for what its sparse part says.
TEST_F(GltfDocument, IndicesMayBeSparse) {
    GltfBuilder builder = make_quad();
    const int places = builder.add_view(std::vector<uint8_t>{1, 2});
    const int values = builder.add_view(std::vector<uint16_t>{1, 2});
    builder.json["meshes"][0]["primitives"][0]["indices"] =
        builder.push("accessors", {{"componentType", 5123},
                                   {"type", "SCALAR"},
                                   {"count", 3},
                                   {"sparse",
                                    {{"count", 2},
                                     {"indices", {{"bufferView", places}, {"componentType", 5121}}},
                                     {"values", {{"bufferView", values}}}}}});
    const Level level = gltf::import_bytes(builder.glb(), "test");
    EXPECT_EQ(level.meshes.at(0).indices, (std::vector<uint32_t>{0, 1, 2}));
}

TEST_F(GltfDocument, IntegersMayBeWrittenWithPointAndExponent) {
    Parts parts;
    std::string text = parts.with_data(";base64");
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"\"byteLength\":140", "\"byteLength\":1.4e2"},
             {"\"byteOffset\":48", "\"byteOffset\":48.0"},
             {"\"componentType\":5126", "\"componentType\":5126.0"},
             {"\"count\":4", "\"count\":4.0"},
             {"\"mesh\":0", "\"mesh\":0.0"},
             {"\"POSITION\":0", "\"POSITION\":0E0"},
             {"\"nodes\":[0]", "\"nodes\":[0.0]"},
             {"\"scene\":0", "\"scene\":-0.0"}}) {
        const size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
    }
    expect_quad(text);
}

TEST_F(GltfDocument, NumbersThatAreNoIntegersAreNamed) {
    const auto cause = [&](const char* pointer, const Json& value) {
        Parts parts;
        parts.with_data(";base64");
        parts.json[Json::json_pointer(pointer)] = value;
        return cause_of(parts.json.dump());
    };
    expect_has(cause("/nodes/0/mesh", 0.5), {"nodes[0].mesh is 0.5", "integer"});
    expect_has(cause("/scenes/0/nodes/0", 1.25), {"scenes[0].nodes[0] is 1.25"});
    expect_has(cause("/meshes/0/primitives/0/attributes/POSITION", 0.5),
               {"meshes[0].primitives[0].attributes.POSITION is 0.5"});
    expect_has(cause("/bufferViews/1/byteOffset", -48), {"bufferViews[1].byteOffset is -48"});
    expect_has(cause("/accessors/0/count", 4.5), {"accessors[0].count is 4.5"});
    expect_has(cause("/nodes/0/mesh", uint64_t{1} << 32), {"nodes[0].mesh", "out of range"});
    EXPECT_EQ(cause("/nodes/0/extras", {{"mesh", 0.5}}), "");
    EXPECT_EQ(cause("/nodes/0/extensions", {{"ANY_thing", {{"count", 0.5}}}}), "");
}

TEST_F(GltfDocument, OtherVersionsAreNamed) {
    Parts parts;
    parts.with_data(";base64");
    parts.json["asset"] = {{"version", "1.0"}};
    expect_has(cause_of(parts.json.dump()), {"version 1.0"});
    parts.json["asset"] = {{"version", "2.1"}};
    expect_quad(parts.json.dump());
    parts.json["asset"] = {{"version", "2.1"}, {"minVersion", "2.1"}};
    expect_has(cause_of(parts.json.dump()), {"needs glTF version 2.1"});
    parts.json.erase("asset");
    expect_has(cause_of(parts.json.dump()), {"asset"});
}

TEST_F(GltfDocument, MissingImagesAreNamed) {
    expect_has(
        note_of({{"uri", "textures/bark%20old.png"}, {"name", "bark"}}),
        {"image 0 (bark, textures/bark%20old.png)", "chequerboard", "there is no such file"});
    expect_has(note_of({{"uri", "30%.png"}}), {"image 0 (30%.png)", "%25"});
    expect_has(note_of({{"name", "none"}}), {"image 0 (none)", "neither a uri nor a buffer view"});
    expect_has(note_of({{"uri", "a.png"}, {"bufferView", 0}}), {"both a uri and a buffer view"});
    expect_has(note_of({{"bufferView", 99}}), {"image 0", "buffer view 99", "does not exist"});
    expect_has(note_of({{"uri", "a.png"}}, {{"source", 7}}), {"image 7", "does not exist"});
}

TEST_F(GltfDocument, ImagesOfOtherFormatsAreNamed) {
    expect_has(note_of({{"uri", "data:image/webp;base64,UklGRgAAAABXRUJQAAAA"}}),
               {"image 0 (a data URI of type image/webp)", "a WebP file"});
    expect_has(note_of({{"uri", "data:image/ktx2;base64,q0tUWCAyMLsNChoKAAAA"}}), {"a KTX file"});
    expect_has(note_of({{"uri", "data:image/x,nothing+known"}}), {"neither PNG nor JPEG"});
}

TEST_F(GltfDocument, TexturesWithoutACoreImageSayWhoHasIt) {
    for (const char* extension : {"KHR_texture_basisu", "EXT_texture_webp", "MSFT_texture_dds"}) {
        const Json texture = {{"name", "wall"}, {"extensions", {{extension, {{"source", 0}}}}}};
        const std::string note = note_of({{"uri", "data:,x"}}, texture);
        expect_has(note, {"texture 0 (wall)", "chequerboard", extension});
        EXPECT_EQ(note.find("image -1"), std::string::npos) << note;
    }
    expect_has(note_of({{"uri", "data:,x"}}, Json::object()), {"texture 0", "names no image"});
}

} // namespace
} // namespace host::test
