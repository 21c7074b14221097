#include "scores.h"

#include <gtest/gtest.h>

#include "full_disk.h"
#include "scratch_folder.h"

using namespace host;
using three_cores::Difficulty;

namespace {

class ScoresTest : public testing::Test {
protected:
    ScratchFolder folder;
    std::filesystem::path file = folder.path() / "share" / "scores.json";
    std::string note;
};

TEST_F(ScoresTest, TheBestOfEachIsFoundAgain) {
    Scores scores;
    EXPECT_FALSE(scores.best("hall", Difficulty::easy));
    const auto first = scores.add("hall", Difficulty::easy, {90.5, 1000});
    EXPECT_TRUE(first.time && first.score);
    const auto slower = scores.add("hall", Difficulty::easy, {99.0, 2000});
    EXPECT_FALSE(slower.time);
    EXPECT_TRUE(slower.score);
    const auto worse = scores.add("hall", Difficulty::easy, {99.0, 2000});
    EXPECT_FALSE(worse.time || worse.score);
    scores.add("hall", Difficulty::hard, {200.0, 1});
    scores.add("a \"strange\"\nlevel \xff", Difficulty::normal, {1.0, 2});
    EXPECT_EQ(scores.write(file), "");

    const Scores read = Scores::read(file, note);
    EXPECT_EQ(note, "");
    EXPECT_EQ(read.best("hall", Difficulty::easy), (BestResult{90.5, 2000}));
    EXPECT_EQ(read.best("hall", Difficulty::hard), (BestResult{200.0, 1}));
    EXPECT_FALSE(read.best("hall", Difficulty::normal));
    EXPECT_FALSE(read.best("cellar", Difficulty::easy));
}

TEST_F(ScoresTest, DamagedEntriesAreLeftOut) {
    std::filesystem::create_directories(file.parent_path());
    write_text(file, R"({"hall": {"easy": {"seconds": 12, "score": 5},
                                  "normal": {"seconds": -1, "score": 5},
                                  "hard": {"seconds": 3, "score": 99999999999}},
                         "cellar": 7, "attic": {"easy": {"seconds": 1}}})");
    const Scores scores = Scores::read(file, note);
    EXPECT_NE(note.find("left out"), std::string::npos);
    EXPECT_EQ(scores.best("hall", Difficulty::easy), (BestResult{12.0, 5}));
    EXPECT_FALSE(scores.best("hall", Difficulty::normal));
    EXPECT_FALSE(scores.best("hall", Difficulty::hard));
    EXPECT_FALSE(scores.best("attic", Difficulty::easy));
}

TEST_F(ScoresTest, ABrokenFileIsKeptAside) {
    std::filesystem::create_directories(file.parent_path());
    write_text(file, "{");
    EXPECT_FALSE(Scores::read(file, note).best("hall", Difficulty::easy));
    EXPECT_NE(note.find("scores.json.broken"), std::string::npos) << note;
    EXPECT_EQ(read_text(file.string() + ".broken"), "{");
}

TEST_F(ScoresTest, AFullDiskLeavesTheOldFile) {
    Scores scores;
    scores.add("hall", Difficulty::easy, {90.5, 1000});
    ASSERT_EQ(scores.write(file), "");
    scores.add("hall", Difficulty::easy, {80.0, 3000});
    {
        const FullDisk full;
        EXPECT_NE(scores.write(file).find("The best times cannot be kept in"), std::string::npos);
    }
    EXPECT_EQ(Scores::read(file, note).best("hall", Difficulty::easy), (BestResult{90.5, 1000}));
    EXPECT_EQ(scores.best("hall", Difficulty::easy), (BestResult{80.0, 3000}));
    EXPECT_EQ(scores.write("/proc/nowhere/scores.json").substr(0, 14), "The best times");
}

} // namespace
