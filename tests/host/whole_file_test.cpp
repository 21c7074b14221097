#include <filesystem>

#include <gtest/gtest.h>

#include <unistd.h>

#include "../ui/full_disk.h"
#include "../ui/scratch_folder.h"
#include "error.h"
#include "image_file.h"
#include "outputs.h"
#include "whole_file.h"

// Files that are written for the user: whole, or not at all and with a cause.
namespace host::test {
namespace {

namespace fs = std::filesystem;

class WholeFile : public testing::Test {
protected:
    size_t count() const {
        return static_cast<size_t>(std::distance(fs::directory_iterator(folder.path()), {}));
    }
    ScratchFolder folder;
    fs::path file = folder.path() / "file";
};

TEST_F(WholeFile, IsWrittenAndWrittenAgain) {
    EXPECT_EQ(write_whole_file(file, "one"), "");
    EXPECT_EQ(write_whole_file(file, "another"), "");
    EXPECT_EQ(read_text(file), "another");
    EXPECT_EQ(count(), 1u);
}

TEST_F(WholeFile, AFullDiskLeavesTheOldOne) {
    const std::string old(5000, 'o'), other(9000, 'n');
    ASSERT_EQ(write_whole_file(file, old), "");
    {
        const FullDisk full(1000);
        EXPECT_NE(write_whole_file(file, other), "");
        EXPECT_NE(write_whole_file(folder.path() / "second", other), "");
    }
    EXPECT_EQ(read_text(file), old);
    EXPECT_EQ(count(), 1u);
    EXPECT_NE(write_whole_file("/dev/full", "x"), "");
    EXPECT_EQ(write_whole_file("/dev/null", "x"), "");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(WholeFile, ALinkStaysALink) {
    ASSERT_EQ(write_whole_file(file, "one"), "");
    const fs::path link = folder.path() / "link";
    fs::create_symlink(file, link);
    EXPECT_EQ(write_whole_file(link, "two"), "");
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(read_text(file), "two");
}

TEST_F(WholeFile, CanBeTriedBeforehand) {
    EXPECT_EQ(try_whole_file(file), "");
    EXPECT_EQ(count(), 0u);
    ASSERT_EQ(write_whole_file(file, "one"), "");
    EXPECT_EQ(try_whole_file(file), "");
    EXPECT_EQ(read_text(file), "one");
    EXPECT_EQ(try_whole_file("/dev/null"), "");
    for (const char* bad : {"/dev/full", "/proc/nowhere", "/nonexistent/file", "/tmp"})
        EXPECT_NE(try_whole_file(bad), "") << bad;
    const FullDisk full(0);
    EXPECT_NE(try_whole_file(file), "");
    EXPECT_EQ(read_text(file), "one");
}

TEST_F(WholeFile, WhatIsAskedForIsTriedAtTheStart) {
    const auto cause_of = [](const Options& options) -> std::string {
        try {
            check_outputs(options);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    Options options;
    EXPECT_EQ(cause_of(options), "");
    options.record = file.string();
    options.stats = (folder.path() / "stats.json").string();
    EXPECT_EQ(cause_of(options), "");
    for (const char* bad : {"/dev/full", "/proc/nowhere", "/tmp"}) {
        Options recording, measuring, drawing;
        recording.record = measuring.stats = drawing.out = bad;
        drawing.headless = true;
        EXPECT_EQ(cause_of(recording).rfind("the replay " + std::string(bad), 0), 0u);
        EXPECT_EQ(cause_of(measuring).rfind("the statistics " + std::string(bad), 0), 0u);
        EXPECT_EQ(cause_of(drawing).rfind("the picture " + std::string(bad), 0), 0u);
    }
}

TEST_F(WholeFile, PicturesAreWhatTheirNamesSay) {
    const std::vector<uint8_t> pixels(size_t{4} * 16 * 8, 200);
    const std::pair<const char*, const char*> formats[] = {{"a.png", "\x89PNG"},
                                                           {"a", "\x89PNG"},
                                                           {"a.jpg", "\xff\xd8\xff"},
                                                           {"a.JPEG", "\xff\xd8\xff"},
                                                           {"a.bmp", "BM"}};
    for (const auto& [name, begin] : formats) {
        EXPECT_TRUE(is_picture_name(name));
        write_picture_file(folder.path() / name, 16, 8, pixels);
        EXPECT_EQ(read_text(folder.path() / name).rfind(begin, 0), 0u) << name;
    }
    write_picture_file(folder.path() / "a.tga", 16, 8, pixels);
    EXPECT_GT(read_text(folder.path() / "a.tga").size(), 18u);
    for (const char* name : {"a.gif", "a.exr", "a.txt", "a.jpg.x"})
        EXPECT_FALSE(is_picture_name(name)) << name;
}

TEST_F(WholeFile, APictureThatCannotBeWrittenIsASentence) {
    const std::vector<uint8_t> pixels(size_t{4} * 64 * 64, 200);
    EXPECT_THROW(write_picture_file("/dev/full", 64, 64, pixels), InputError);
    EXPECT_THROW(write_picture_file("/proc/a.png", 64, 64, pixels), InputError);
    const FullDisk full;
    EXPECT_THROW(write_picture_file(folder.path() / "a.png", 64, 64, pixels), InputError);
    EXPECT_EQ(count(), 0u);
}

TEST_F(WholeFile, AScreenshotFindsAName) {
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    EXPECT_EQ(free_screenshot_name(), "screenshot_0000.png");
    write_text("screenshot_0000.png", "");
    EXPECT_EQ(free_screenshot_name(), "screenshot_0001.png");
    const fs::path gone = folder.path() / "gone";
    fs::create_directory(gone);
    fs::current_path(gone);
    fs::remove(gone);
    EXPECT_EQ(free_screenshot_name(), "screenshot_0000.png");
    fs::current_path(before);
}

} // namespace
} // namespace host::test
