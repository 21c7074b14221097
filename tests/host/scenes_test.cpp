#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gltf/import.h"

// Real files, kept outside of the repository: PEREGRINE_SCENES, else ../shared/scenes beside it.
namespace host::test {
namespace {

namespace fs = std::filesystem;

fs::path scenes_folder() {
    if (const char* variable = std::getenv("PEREGRINE_SCENES"); variable && *variable)
        return variable;
    return fs::path(PEREGRINE_SOURCE_DIR) / "../shared/scenes";
}

bool is_scene(const fs::path& path) {
    return path.extension() == ".glb" || path.extension() == ".gltf";
}

class Scenes : public testing::Test {
protected:
    void SetUp() override {
        if (!fs::is_directory(scenes_folder()))
            GTEST_SKIP() << "there is no folder of scenes: set PEREGRINE_SCENES to one";
    }
};

TEST_F(Scenes, AllImport) {
    size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(scenes_folder())) {
        if (!is_scene(entry.path())) continue;
        SCOPED_TRACE(entry.path().string());
        const Level level = gltf::import_file(entry.path());
        EXPECT_GT(level.triangle_count(), 0u);
        EXPECT_FALSE(level.bounds.empty());
        for (const std::string& note : level.notes)
            EXPECT_EQ(note.find("chequerboard"), std::string::npos) << note;
        ++count;
    }
    EXPECT_GT(count, 0u);
}

TEST_F(Scenes, AgreeWithTheirDescriptions) {
    for (const auto& entry : fs::directory_iterator(scenes_folder())) {
        if (entry.path().extension() != ".json") continue;
        SCOPED_TRACE(entry.path().string());
        const auto facts = nlohmann::json::parse(std::ifstream(entry.path()));
        const Level level = gltf::import_file(fs::path(entry.path()).replace_extension(".glb"));
        EXPECT_EQ(level.triangle_count(), facts["triangles"].get<size_t>());
        EXPECT_EQ(level.cameras.size(), facts["cameras"].size());
        const size_t suns = facts.contains("suns") ? facts["suns"].size() : 0;
        EXPECT_EQ(level.lights.size(), facts["lights"].size() + suns);
        const size_t spawns = facts.contains("spawns") ? facts["spawns"].size() : 0;
        EXPECT_EQ(level.spawns.size(), spawns);
        for (size_t axis = 0; axis < 3; ++axis) {
            const int a = static_cast<int>(axis);
            EXPECT_NEAR(level.bounds.lower[a], facts["bounds"][0][axis].get<double>(), 1e-3);
            EXPECT_NEAR(level.bounds.upper[a], facts["bounds"][1][axis].get<double>(), 1e-3);
        }
    }
}

// The skin stands the man up: without it he would lie along z.
TEST_F(Scenes, TheManStandsUpright) {
    const fs::path path = scenes_folder() / "gltf/CesiumMan.glb";
    if (!fs::exists(path)) GTEST_SKIP() << "the folder of scenes has no CesiumMan.glb";
    const Bounds bounds = gltf::import_file(path).bounds;
    const glm::dvec3 size = bounds.upper - bounds.lower;
    EXPECT_GT(size.y, size.x);
    EXPECT_GT(size.y, size.z);
    EXPECT_NEAR(size.y, 1.5, 0.3);
}

} // namespace
} // namespace host::test
