#pragma once

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "error.h"
#include "gltf/import.h"
#include "gltf_builder.h"

namespace host::test {

inline std::string to_base64(const std::string& bytes) {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

// A quad whose bytes lie in a buffer of its own choice.
struct Parts {
    Json json = make_quad().json;
    std::string bin = make_quad().bin();

    std::string with_uri(const std::string& uri) {
        json["buffers"] = {{{"byteLength", bin.size()}, {"uri", uri}}};
        return json.dump();
    }
    std::string with_data(const std::string& type) {
        return with_uri("data:" + type + "," + to_base64(bin));
    }
};

class SceneFolder : public testing::Test {
protected:
    SceneFolder()
        : folder_(std::filesystem::temp_directory_path()
                  / ("gltf_files_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_ / "textures");
    }
    ~SceneFolder() override { std::filesystem::remove_all(folder_); }

    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }

    Level import(const std::string& document) const {
        write("scene.gltf", document);
        return gltf::import_file(folder_ / "scene.gltf");
    }

    std::string cause_of(const std::string& document) const {
        try {
            import(document);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    void expect_quad(const std::string& document) const {
        EXPECT_EQ(cause_of(document), "");
        const Level level = import(document);
        ASSERT_EQ(level.meshes.size(), 1u);
        EXPECT_EQ(level.meshes[0].positions[2], glm::vec3(1, 1, 0));
        EXPECT_EQ(level.triangle_count(), 2u);
    }

    // A quad that shows one image.
    std::string note_of(const Json& image, const Json& texture = {{"source", 0}}) const {
        Parts parts;
        parts.json["images"] = {image};
        parts.json["textures"] = {texture};
        parts.json["materials"] = {
            {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        parts.json["meshes"][0]["primitives"][0]["material"] = 0;
        const Level level = import(parts.with_data("application/octet-stream;base64"));
        EXPECT_EQ(level.images.size(), 1u);
        std::string notes;
        for (const std::string& note : level.notes) notes += note + "\n";
        return notes;
    }

    std::filesystem::path folder_;
};

inline void expect_has(const std::string& text, std::initializer_list<const char*> parts) {
    for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
}

} // namespace host::test
