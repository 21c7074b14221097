#include <random>

#include "scene_folder.h"

// What a document may name: chunks, files beside it and data URIs, legal in ways that loaders
// refuse, and what is said of those that are not.
namespace host::test {
namespace {

namespace fs = std::filesystem;

using GltfFiles = SceneFolder;

TEST_F(GltfFiles, BuffersMayBeLongerThanTheirLength) {
    Parts parts;
    write("quad.bin", parts.bin + "more");
    expect_quad(parts.with_uri("quad.bin"));
    const std::string longer = parts.bin + "and more";
    expect_quad(parts.with_uri("data:application/octet-stream;base64," + to_base64(longer)));
    parts.json["buffers"] = {{{"byteLength", parts.bin.size()}}};
    std::string text = parts.json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    expect_quad(GltfBuilder::wrap(text, parts.bin + std::string(40, 'x')));
}

TEST_F(GltfFiles, BuffersMayNotBeShorter) {
    Parts parts;
    write("quad.bin", parts.bin.substr(4));
    expect_has(cause_of(parts.with_uri("quad.bin")),
               {"buffer 0 (quad.bin)", "holds 136 bytes", "byteLength of 140"});
}

// One file, however it is written, is read once: a small document must not ask for gigabytes.
TEST_F(GltfFiles, BuffersMayShareAFile) {
    Parts parts;
    write("quad.bin", parts.bin);
    parts.with_uri("quad.bin");
    for (const char* uri : {"quad.bin", "./quad.bin", "textures/../quad.bin", "%71uad.bin"})
        parts.json["buffers"].push_back({{"byteLength", 8}, {"uri", uri}});
    parts.json["bufferViews"][1]["buffer"] = 1;
    parts.json["buffers"][1]["byteLength"] = parts.bin.size();
    expect_quad(parts.json.dump());
}

TEST_F(GltfFiles, BuffersMayHoldEqualDataUris) {
    Parts parts;
    parts.with_data("application/octet-stream;base64");
    parts.json["buffers"].push_back(parts.json["buffers"][0]);
    parts.json["bufferViews"][1]["buffer"] = 1;
    expect_quad(parts.json.dump());
}

TEST_F(GltfFiles, ImagesMayShareABuffersFile) {
    Parts parts;
    write("quad.bin", parts.bin);
    parts.json["images"] = {{{"uri", "quad.bin"}}, {{"uri", "quad.bin"}}};
    expect_quad(parts.with_uri("quad.bin"));
}

TEST_F(GltfFiles, NamesAreDecodedAsUris) {
    for (const auto& [name, uri] : std::vector<std::pair<std::string, std::string>>{
             {"a+b.bin", "a+b.bin"},
             {"a+b.bin", "a%2Bb.bin"},
             {"a+b.bin", "a%2bb.bin"},
             {"a b.bin", "a%20b.bin"},
             {"a b.bin", "a b.bin"},
             {"gr\xc3\xbcn.bin", "gr%C3%BCn.bin"},
             {"gr\xc3\xbcn.bin", "gr\xc3\xbcn.bin"},
             {"100%.bin", "100%25.bin"},
             {"100%.bin", "100%.bin"},
             {"5%zz.bin", "5%zz.bin"},
             {"a%20b.bin", "a%2520b.bin"},
             {"a#b?c.bin", "a%23b%3Fc.bin"},
             {"a#b?c.bin", "a#b?c.bin"},
             {"a:b.bin", "a%3Ab.bin"},
             {"textures/quad.bin", "textures/quad.bin"},
             {"textures/quad.bin", "./textures/./quad.bin"},
             {"textures/quad.bin", "nowhere/../textures/quad.bin"},
             {"textures/quad.bin", "textures%2Fquad.bin"},
         }) {
        SCOPED_TRACE(uri);
        Parts parts;
        write(name, parts.bin);
        expect_quad(parts.with_uri(uri));
        fs::remove(folder_ / name);
    }
}

TEST_F(GltfFiles, FilesAboveTheScene) {
    Parts parts;
    write("quad.bin", parts.bin);
    const std::string up = "../" + folder_.filename().string() + "/quad.bin";
    expect_quad(parts.with_uri(up));
}

TEST_F(GltfFiles, DataUrisOfAnyKind) {
    Parts parts;
    for (const char* type :
         {"application/octet-stream;base64", "application/gltf-buffer;base64",
          "APPLICATION/Octet-Stream;BASE64", "application/octet-stream;charset=utf-8;base64",
          "application/x-bin;name=\"a;b\";base64", "model/gltf-buffer;base64", ";base64",
          "text/plain;charset=US-ASCII;base64"})
        expect_quad(parts.with_data(type));
    std::string data = to_base64(parts.bin);
    expect_quad(parts.with_uri("DATA:;base64," + data));
    while (data.back() == '=') data.pop_back();
    expect_quad(parts.with_uri("data:;base64," + data));
    expect_quad(parts.with_uri("data:;base64," + data + "%3D"));
    expect_quad(parts.with_uri("data:;base64," + data.substr(0, 64) + "\r\n " + data.substr(64)));
    std::string escaped;
    for (const char c : parts.bin) {
        char code[4];
        std::snprintf(code, sizeof code, "%%%02x", static_cast<unsigned>(static_cast<uint8_t>(c)));
        escaped += code;
    }
    expect_quad(parts.with_uri("data:application/octet-stream," + escaped));
}

TEST_F(GltfFiles, DataUrisThatAreNone) {
    Parts parts;
    expect_has(cause_of(parts.with_uri("data:application/octet-stream;base64")),
               {"buffer 0", "application/octet-stream", "comma"});
    expect_has(cause_of(parts.with_uri("data:model/x;base64,AAAA*AAA")),
               {"buffer 0 (a data URI of type model/x)", "'*'"});
    expect_has(cause_of(parts.with_uri("data:;base64,AAAAA")), {"buffer 0", "ends within a byte"});
    expect_has(cause_of(parts.with_uri("data:;base64,")), {"buffer 0", "holds 0 bytes"});
    const std::string cause = cause_of(parts.with_uri("data:;base64," + std::string(1 << 20, 'A')));
    EXPECT_EQ(cause, ""); // longer than declared
    EXPECT_LT(cause_of(parts.with_uri("data:" + std::string(1 << 20, 'x'))).size(), 300u);
}

TEST_F(GltfFiles, DamagedDocumentsAreSurvived) {
    Parts parts;
    write("a b+c.bin", parts.bin);
    std::mt19937 random(3986);
    for (const std::string& text : {parts.with_uri("./textures/../a%20b+c.bin"),
                                    parts.with_data("model/x;charset=utf-8;base64")})
        for (int round = 0; round < 500; ++round) {
            std::string damaged = text;
            for (uint32_t flips = 1 + random() % 3; flips > 0; --flips)
                damaged[random() % damaged.size()] ^= static_cast<char>(1u << random() % 8);
            const std::string cause = cause_of(damaged);
            if (!cause.empty()) expect_has(cause, {"scene.gltf cannot be used: "});
        }
}

TEST_F(GltfFiles, AByteOrderMarkIsPassedOver) {
    expect_quad("\xef\xbb\xbf" + Parts().with_data(";base64"));
}

TEST_F(GltfFiles, MissingBuffersAreNamed) {
    Parts parts;
    expect_has(cause_of(parts.with_uri("far%20away.bin")),
               {"buffer 0 (far%20away.bin)", "there is no such file"});
    expect_has(cause_of(parts.with_uri("50%.bin")), {"buffer 0 (50%.bin)", "no such file", "%25"});
    expect_has(cause_of(parts.with_uri("textures")), {"(textures)", "not a regular file"});
    expect_has(cause_of(parts.with_uri("/dev/zero")), {"(/dev/zero)", "beside the scene"});
    expect_has(cause_of(parts.with_uri("https://example.org/a.bin")), {"beside the scene"});
    expect_has(cause_of(parts.with_uri("a%00.bin")), {"zero byte"});
}

// What lies where the program runs is not beside the scene.
TEST_F(GltfFiles, TheWorkingFolderIsNotSearched) {
    const fs::path before = fs::current_path();
    Parts parts;
    write("textures/quad.bin", parts.bin);
    fs::current_path(folder_ / "textures");
    EXPECT_NE(cause_of(parts.with_uri("quad.bin")), "");
    fs::current_path(before);
}

TEST_F(GltfFiles, BuffersWithoutAUriAreLegalWhileUnused) {
    Parts parts;
    parts.with_data(";base64");
    parts.json["buffers"].push_back({{"byteLength", 100}});
    expect_quad(parts.json.dump());
    parts.json["bufferViews"][0]["buffer"] = 1;
    expect_has(cause_of(parts.json.dump()), {"accessor 0", "buffer 1", "no uri"});
}

TEST_F(GltfFiles, TheBinChunkIsTheFirstBufferOnly) {
    GltfBuilder builder = make_quad();
    const size_t size = builder.bin().size();
    builder.json["buffers"] = {{{"byteLength", 4}, {"uri", "data:;base64,AAAAAA"}},
                               {{"byteLength", size}}};
    expect_has(cause_of(builder.glb()), {"buffer view 0", "beyond its buffer"});
    for (Json& view : builder.json["bufferViews"]) view["buffer"] = 1;
    expect_has(cause_of(builder.glb()), {"buffer 1", "no uri"});
}

TEST_F(GltfFiles, ChunksOfAnyKind) {
    Parts parts;
    std::string text = parts.with_data(";base64");
    text.resize((text.size() + 3) / 4 * 4, ' ');
    expect_quad(GltfBuilder::wrap(text, "")); // an empty BIN chunk
    const auto chunk = [](uint32_t type, const std::string& bytes) {
        std::string head(8, '\0');
        const auto size = static_cast<uint32_t>(bytes.size());
        std::memcpy(head.data(), &size, 4);
        std::memcpy(head.data() + 4, &type, 4);
        return head + bytes;
    };
    const auto glb = [&](const std::string& chunks) {
        std::string head = "glTF";
        const uint32_t numbers[] = {2, static_cast<uint32_t>(12 + chunks.size())};
        head.append(reinterpret_cast<const char*>(numbers), 8);
        return head + chunks;
    };
    const std::string json = chunk(0x4e4f534a, text);
    parts.json["buffers"] = {{{"byteLength", parts.bin.size()}}};
    const std::string bare = chunk(0x4e4f534a, parts.json.dump());
    const std::string bin = chunk(0x004e4942, parts.bin), other = chunk(0x12345678, "anything");
    expect_quad(glb(json));
    expect_quad(glb(json + other));
    expect_quad(glb(bare + bin + other + other));
    expect_quad(glb(bare + other + bin)); // passed over where it is not expected either
    expect_quad(glb(chunk(0x4e4f534a, parts.json.dump() + std::string(3, '\0')) + bin));
    expect_quad(glb(bare + bin) + "trailing");
    expect_has(cause_of(glb(bare)), {"accessor 0", "buffer 0", "no uri"});
    expect_has(cause_of(glb(bare + chunk(0x004e4942, ""))),
               {"the BIN chunk", "holds 0 bytes", "byteLength of 140"});
    expect_has(cause_of(glb(bin + bare)), {"first chunk"});
}

} // namespace
} // namespace host::test
