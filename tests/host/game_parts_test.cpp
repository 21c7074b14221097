#include <gtest/gtest.h>

#include "error.h"
#include "game/feedback.h"
#include "game/frame_detail.h"
#include "game/pace.h"
#include "game/reckoning.h"
#include "game/round.h"

// The small parts of the game's host that need no engine.
namespace host::test {
namespace {

using game::FrameDetail;
using game::RoundSeed;

rt_frame_stats took(double ms) {
    rt_frame_stats stats = rt_default_frame_stats();
    stats.frame_ms = ms;
    return stats;
}

TEST(FrameDetail, LeavesTheGovernorWhatElseAFrameTakes) {
    FrameDetail detail;
    for (int i = 0; i < 200; ++i) detail.update(50, took(40), 0);
    EXPECT_NEAR(detail.governor().target_ms, FrameDetail::target_ms - 10, 1e-3);
    for (int i = 0; i < 200; ++i) detail.update(500, took(40), 0);
    EXPECT_NEAR(detail.governor().target_ms, FrameDetail::target_ms / 4, 1e-3);
}

TEST(FrameDetail, ShowsTheGovernorEachFrameOnce) {
    FrameDetail detail;
    Frame frame;
    detail.describe(frame);
    EXPECT_EQ(frame.governor, &detail.governor());
    EXPECT_EQ(frame.last, nullptr);
    detail.update(50, took(40), 0);
    Frame second, third;
    detail.describe(second);
    ASSERT_NE(second.last, nullptr);
    EXPECT_EQ(second.last->frame_ms, 40);
    detail.describe(third);
    EXPECT_EQ(third.last, nullptr);
}

TEST(FrameDetail, TheChosenSizeWins) {
    FrameDetail detail;
    detail.update(500, took(500), 0.8);
    Frame frame;
    frame.width = 1000;
    frame.height = 1;
    detail.describe(frame);
    EXPECT_EQ(frame.governor, nullptr);
    EXPECT_EQ(frame.traced_width, 800u);
    EXPECT_EQ(frame.traced_height, 1u);
}

TEST(Pace, TellsATimeThatIsTooSlow) {
    const auto speed_at = [](double frame) {
        game::Pace pace;
        for (double time = 0; time < 10; time += frame)
            pace.add(frame, std::min(frame, game::longest_frame));
        return pace.speed();
    };
    EXPECT_DOUBLE_EQ(speed_at(1.0 / 60), 1.0);
    EXPECT_DOUBLE_EQ(speed_at(0.11), 1.0); // nine frames a second keep the time
    EXPECT_DOUBLE_EQ(speed_at(0.25), 1.0);
    EXPECT_NEAR(speed_at(0.5), 0.5, 1e-9);
    game::Pace pace;
    pace.add(1.0 / 60, 1.0 / 60);
    pace.add(30, game::longest_frame); // it slept
    EXPECT_FALSE(pace.is_slow());
    for (int i = 0; i < 10; ++i) pace.add(0.4, game::longest_frame);
    EXPECT_TRUE(pace.is_slow());
    for (int i = 0; i < 600; ++i) pace.add(1.0 / 60, 1.0 / 60);
    EXPECT_FALSE(pace.is_slow());
}

TEST(RoundSeed, IsAWord) {
    for (const auto difficulty : {three_cores::Difficulty::easy, three_cores::Difficulty::hard}) {
        const RoundSeed seed{difficulty, (uint64_t{1} << 56) - 7};
        const auto again = RoundSeed::from_word(seed.word());
        ASSERT_TRUE(again);
        EXPECT_EQ(again->difficulty, difficulty);
        EXPECT_EQ(again->seed, seed.seed);
    }
    EXPECT_FALSE(RoundSeed::from_word(~uint64_t{0}));
}

TEST(Replays, OfOthersAreRefused) {
    three_cores::Plan plan;
    plan.level = 5;
    gameplay::Replay replay;
    replay.level = 5;
    replay.seed = RoundSeed{three_cores::Difficulty::hard, 9}.word();
    EXPECT_EQ(game::check_replay(replay, plan).seed, 9u);
    const auto refuses = [&](auto change, const char* word) {
        gameplay::Replay other = replay;
        change(other);
        try {
            game::check_replay(other, plan);
        } catch (const InputError& error) {
            return std::string(error.what()).find(word) != std::string::npos;
        }
        return false;
    };
    EXPECT_TRUE(refuses([](gameplay::Replay& r) { r.level = 6; }, "another level"));
    EXPECT_TRUE(refuses([](gameplay::Replay& r) { r.ticks_per_second = 50; }, "50 ticks"));
    EXPECT_TRUE(refuses([](gameplay::Replay& r) { r.seed = ~uint64_t{0}; }, "difficulty"));
}

TEST(Reckoning, AWinIsToldAsItWas) {
    three_cores::Status quiet;
    quiet.cores = quiet.cores_total = 3;
    quiet.drones = quiet.drones_total = 6;
    quiet.lives = 3;
    const auto told = [&](auto change) {
        three_cores::Status status = quiet;
        change(status);
        return game::story_of(status, 3);
    };
    const std::string silent = told([](auto&) {});
    EXPECT_EQ(silent, "All three cores are yours, and the night keeps quiet.");
    const auto is_quiet = [](const std::string& story) {
        return story.find("quiet") != std::string::npos;
    };
    EXPECT_FALSE(is_quiet(told([](auto& s) { s.alarms = 1; })));
    EXPECT_FALSE(is_quiet(told([](auto& s) { s.lives = 2; })));
    EXPECT_FALSE(is_quiet(told([](auto& s) { s.drones = 4; })));
    EXPECT_FALSE(is_quiet(told([](auto& s) { s.drones = 0, s.alarms = 2; })));
    EXPECT_NE(told([](auto& s) { s.alarms = 4; }).find("4 times"), std::string::npos);
    EXPECT_NE(told([](auto& s) { s.lives = 1, s.alarms = 4; }).find("last life"),
              std::string::npos);
    EXPECT_EQ(told([](auto& s) { s.cores = s.cores_total = 1; }).find("The core is"), 0u);
}

TEST(Feedback, TheLightTellsTheAlarm) {
    const auto calm = game::Feedback::light_of(0, false);
    const auto alarmed = game::Feedback::light_of(1, true);
    const auto suspicious = game::Feedback::light_of(0.5, false);
    EXPECT_GT(calm.green, calm.red);
    EXPECT_GT(alarmed.red, alarmed.green);
    EXPECT_GT(suspicious.red, 0);
    EXPECT_GT(suspicious.green, 0);
    EXPECT_EQ(game::Feedback::light_of(0.99, false), suspicious);
    EXPECT_EQ(game::Feedback::light_of(0.2, true), alarmed); // it lasts
}

} // namespace
} // namespace host::test
