#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cameras.h"
#include "error.h"
#include "gltf/import.h"
#include "gltf_builder.h"
#include "headless.h"
#include "plugin.h"
#include "stats.h"
#include "upload.h"
#include "walker.h"

// The host against an engine that is none: see fake_engine.cpp.
namespace host::test {
namespace {

namespace fs = std::filesystem;

std::string cause_of(const std::string& library) {
    try {
        const Plugin plugin(library);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Plugin, LoadsAnEngine) {
    const Plugin plugin(FAKE_ENGINE);
    EXPECT_EQ(plugin.api().version, RT_API_VERSION);
    EXPECT_EQ(plugin.path(), FAKE_ENGINE);
}

TEST(Plugin, ReadsTheEnvironment) {
    setenv("PEREGRINE_LIBRARY", FAKE_ENGINE, 1);
    EXPECT_EQ(cause_of(""), "");
    unsetenv("PEREGRINE_LIBRARY");
}

TEST(Plugin, SaysWhatIsWrong) {
    EXPECT_NE(cause_of("/nonexistent.so").find("does not exist"), std::string::npos);
    EXPECT_NE(cause_of("/proc/self/maps").find("cannot be loaded"), std::string::npos);
    EXPECT_NE(cause_of(FOREIGN_LIBRARY).find("does not export rt_get_api"), std::string::npos);
    EXPECT_NE(cause_of(MUTE_ENGINE).find("does not speak version"), std::string::npos);
}

class HostOnFakeEngine : public testing::Test {
protected:
    HostOnFakeEngine() : plugin(FAKE_ENGINE), stage(plugin.api(), 1, RT_ISA_BEST) {
        level = gltf::import_bytes(make_quad().glb(), "quad");
        level.lights.push_back(default_light());
        options.width = 16;
        options.height = 8;
        options.quiet = true;
        folder = fs::temp_directory_path() / ("peregrine_host_test_" + std::to_string(getpid()));
        fs::create_directories(folder);
    }
    ~HostOnFakeEngine() override { fs::remove_all(folder); }

    Session open() {
        player.emplace(stage, level, upload_level(stage, level, 0.1f));
        player->describe(options.time);
        const rt_commit_report report = stage.commit(options.structure, options.build, nullptr);
        return Session{options, level, usable_cameras(level), 0, stage, *player, report, {}, 0, 0};
    }

    Plugin plugin;
    Stage stage;
    Level level;
    std::optional<Player> player;
    Options options;
    fs::path folder;
};

TEST_F(HostOnFakeEngine, WritesOnePicture) {
    options.out = (folder / "shot.png").string();
    options.frames = 3;
    Session session = open();
    run_headless(session);
    EXPECT_TRUE(fs::exists(options.out));
    EXPECT_EQ(session.log.count(), 3u);
}

TEST_F(HostOnFakeEngine, WritesEveryFrameOfAPattern) {
    options.out = (folder / "made" / "shot_%03d.png").string();
    options.frames = 2;
    Session session = open();
    run_headless(session);
    EXPECT_TRUE(fs::exists(folder / "made" / "shot_000.png"));
    EXPECT_TRUE(fs::exists(folder / "made" / "shot_001.png"));
}

TEST_F(HostOnFakeEngine, TheScaleCountsWithoutAWindow) {
    options.out = (folder / "shot.png").string();
    options.scale = 0.5f;
    Session session = open();
    run_headless(session);
    EXPECT_EQ(session.width, 8u);
    EXPECT_EQ(session.height, 4u);
}

TEST_F(HostOnFakeEngine, SaysWhereItCannotWrite) {
    options.out = "/proc/nowhere/shot.png";
    Session session = open();
    EXPECT_THROW(run_headless(session), InputError);
    EXPECT_THROW(write_stats("/proc/nowhere/stats.json", session), InputError);
}

TEST_F(HostOnFakeEngine, DescribesItsStats) {
    options.out = (folder / "shot.png").string();
    Session session = open();
    run_headless(session);
    const auto stats = nlohmann::json::parse(describe_stats(session));
    EXPECT_EQ(stats["triangles"], 2);
    EXPECT_EQ(stats["lights"], 1);
    EXPECT_EQ(stats["size"], nlohmann::json({16, 8}));
    EXPECT_EQ(stats["rays"]["primary"], 128.0);
    EXPECT_EQ(stats["isa"], "scalar");
    EXPECT_EQ(stats["left_out"], nlohmann::json({"normal_maps", "dynamic_meshes"}));
    for (const char* key :
         {"frame_ms_median", "frame_ms_worst", "mrays_per_s", "build_ms", "commit_ms", "bytes",
          "degenerate", "non_finite", "threads", "scene", "camera", "tree"})
        EXPECT_TRUE(stats.contains(key)) << key;
}

TEST_F(HostOnFakeEngine, EngineFailuresCarryTheEnginesSentence) {
    try {
        stage.check(RT_ERROR_INTERNAL, "trying");
        FAIL();
    } catch (const EngineError& error) {
        EXPECT_NE(std::string(error.what()).find("was asked to fail"), std::string::npos);
    }
}

Viewpoint at(double x, double y, double z) {
    Viewpoint view;
    view.position = {x, y, z};
    view.forward = glm::vec3(1, 0, 0);
    return view;
}

TEST_F(HostOnFakeEngine, AFlyerGoesWhereItLooks) {
    const Probe probe(stage);
    Walker walker(probe);
    walker.place(at(0, 1, 0));
    Controls controls;
    controls.forward = 1.0f;
    for (int i = 0; i < 100; ++i) walker.step(controls, 0.02);
    EXPECT_GT(walker.viewpoint().position.x, 9.0); // through the wall at 5
    EXPECT_NEAR(walker.viewpoint().position.y, 1.0, 1e-9);
}

TEST_F(HostOnFakeEngine, AWalkerFallsToTheFloorAndStopsAtWalls) {
    const Probe probe(stage);
    Walker walker(probe);
    walker.place(at(0, 6, 0));
    walker.toggle_walking();
    Controls controls;
    controls.forward = 1.0f;
    for (int i = 0; i < 300; ++i) walker.step(controls, 0.02);
    EXPECT_NEAR(walker.viewpoint().position.y, 1.65, 0.01);
    EXPECT_LT(walker.viewpoint().position.x, 4.9);
    EXPECT_GT(walker.viewpoint().position.x, 4.3);
    controls.right = 1.0f; // slides along
    for (int i = 0; i < 50; ++i) walker.step(controls, 0.02);
    EXPECT_GT(std::abs(walker.viewpoint().position.z), 1.0);
}

TEST_F(HostOnFakeEngine, LookingIsBoundedAndKeepsTheHeading) {
    const Probe probe(stage);
    Walker walker(probe);
    walker.place(at(0, 1, 0));
    EXPECT_NEAR(walker.viewpoint().forward.x, 1.0f, 1e-6f);
    Controls controls;
    controls.turn = {0.0f, 10.0f};
    walker.step(controls, 0.02);
    EXPECT_GT(walker.viewpoint().forward.y, 0.99f);
    EXPECT_GT(walker.viewpoint().forward.x, 0.0f);
}

} // namespace
} // namespace host::test
