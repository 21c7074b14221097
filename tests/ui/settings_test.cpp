#include "settings.h"

#include <gtest/gtest.h>

#include "full_disk.h"
#include "scratch_folder.h"
#include "user_folders.h"

using namespace host;
namespace fs = std::filesystem;

namespace {

class SettingsTest : public testing::Test {
protected:
    PlayerSettings read_back() {
        note.clear();
        return read_settings(file, note);
    }

    ScratchFolder folder;
    fs::path file = folder.path() / "config" / "three_cores.json";
    std::string note;
};

PlayerSettings unusual() {
    PlayerSettings settings;
    settings.width = 1600;
    settings.height = 900;
    settings.fullscreen = true;
    settings.render_scale = 67;
    settings.field_of_view = 75;
    settings.sensitivity = 1.7;
    settings.invert_look = true;
    settings.volume = 35;
    settings.vibration = false;
    settings.difficulty = three_cores::Difficulty::hard;
    return settings;
}

TEST_F(SettingsTest, AreFoundAgain) {
    EXPECT_EQ(write_settings(file, unusual()), "");
    EXPECT_EQ(read_back(), unusual());
    EXPECT_EQ(note, "");
    EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1);
}

TEST_F(SettingsTest, NoFileMeansDefaultsAndNoNote) {
    EXPECT_EQ(read_back(), PlayerSettings{});
    EXPECT_EQ(note, "");
}

TEST_F(SettingsTest, ABrokenFileIsKeptAside) {
    fs::create_directories(file.parent_path());
    for (const std::string text : {"", "{\"width\": 12", "[1, 2]", "\xff\xfe", "nonsense"}) {
        write_text(file, text);
        EXPECT_EQ(read_back(), PlayerSettings{});
        EXPECT_NE(note.find(file.string()), std::string::npos) << text;
        EXPECT_NE(note.find("three_cores.json.broken"), std::string::npos) << note;
        EXPECT_FALSE(fs::exists(file));
        EXPECT_EQ(read_text(file.string() + ".broken"), text);
    }
}

TEST_F(SettingsTest, NumbersAreClamped) {
    fs::create_directories(file.parent_path());
    write_text(file, R"({"width": 1, "height": 1e99, "render_scale": 3, "field_of_view": 179,
                         "sensitivity": -4, "volume": 1000, "difficulty": 9})");
    const PlayerSettings settings = read_back();
    EXPECT_EQ(note, "");
    EXPECT_EQ(settings.width, 320);
    EXPECT_EQ(settings.height, 16384);
    EXPECT_EQ(settings.render_scale, 25);
    EXPECT_EQ(settings.field_of_view, 90);
    EXPECT_EQ(settings.sensitivity, 0.2);
    EXPECT_EQ(settings.volume, 100);
    EXPECT_EQ(settings.difficulty, three_cores::Difficulty::hard);
}

TEST_F(SettingsTest, AWrongTypeIsNamedAndTheRestIsRead) {
    fs::create_directories(file.parent_path());
    write_text(file, R"({"volume": "loud", "fullscreen": 1, "invert_look": true, "later": []})");
    const PlayerSettings settings = read_back();
    EXPECT_EQ(settings.volume, PlayerSettings{}.volume);
    EXPECT_FALSE(settings.fullscreen);
    EXPECT_TRUE(settings.invert_look);
    EXPECT_NE(note.find("\"fullscreen\""), std::string::npos) << note;
}

TEST_F(SettingsTest, AFullDiskLeavesTheOldFile) {
    ASSERT_EQ(write_settings(file, unusual()), "");
    {
        const FullDisk full;
        const std::string sentence = write_settings(file, {});
        EXPECT_NE(sentence.find(file.string()), std::string::npos) << sentence;
    }
    EXPECT_EQ(read_back(), unusual());
    EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1);
}

TEST_F(SettingsTest, AFileWhereAFolderShouldBeIsASentence) {
    write_text(folder.path() / "config", "in the way");
    EXPECT_NE(write_settings(file, {}).find("cannot be kept in"), std::string::npos);
    EXPECT_EQ(read_text(folder.path() / "config"), "in the way");
}

TEST_F(SettingsTest, AFolderWhereTheFileShouldBeIsASentence) {
    fs::create_directories(file / "inner");
    EXPECT_EQ(read_back(), PlayerSettings{});
    EXPECT_NE(note.find("cannot be read"), std::string::npos) << note;
    EXPECT_NE(write_settings(file, {}), "");
    EXPECT_TRUE(fs::is_directory(file / "inner"));
}

TEST_F(SettingsTest, NoHomeIsASentence) {
    EXPECT_NE(write_settings({}, {}).find("HOME"), std::string::npos);
    EXPECT_EQ(read_settings({}, note), PlayerSettings{});
    EXPECT_EQ(note, "");
}

class Environment : public testing::Test {
protected:
    void SetUp() override {
        for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME"}) {
            const char* value = std::getenv(name);
            before_.emplace_back(name, value ? value : "");
            unsetenv(name);
        }
    }
    void TearDown() override {
        for (const auto& [name, value] : before_)
            if (!value.empty()) setenv(name.c_str(), value.c_str(), 1);
    }

private:
    std::vector<std::pair<std::string, std::string>> before_;
};

TEST_F(Environment, FoldersFollowTheXdgSpecification) {
    EXPECT_TRUE(config_folder().empty());
    EXPECT_TRUE(settings_path().empty());
    setenv("HOME", "/home/somebody", 1);
    EXPECT_EQ(settings_path(), "/home/somebody/.config/peregrine/three_cores.json");
    EXPECT_EQ(data_folder(), "/home/somebody/.local/share/peregrine");
    setenv("XDG_CONFIG_HOME", "/etc/mine", 1);
    EXPECT_EQ(config_folder(), "/etc/mine/peregrine");
    setenv("XDG_CONFIG_HOME", "relative", 1); // to be ignored
    EXPECT_EQ(config_folder(), "/home/somebody/.config/peregrine");
}

} // namespace
