// The rules of Three Cores, one at a time, in rooms made for them.
#include "gameplay/three_cores/game.h"
#include "support/arena.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace peregrine::test {
namespace {

using namespace gameplay;
using namespace three_cores;

// An arena and the plan of what is in it. Everything before start().
class Round : public testing::Test {
protected:
    Arena arena_;
    Plan plan_;
    std::optional<Game> game_;

    Round() {
        arena_.add_floor(30);
        plan_.spawns = {{{0, 0, 0}, {0, 0, -1}}};
        plan_.lower = Vec3(-30, 0, -30);
        plan_.upper = Vec3(30, 5, 30);
    }

    Part mover(const Vec3& lower, const Vec3& upper, const Vec3& at = Vec3(0)) {
        return {
            {arena_.add_mover(lower, upper)}, shifted(rt_default_transform(), at), lower, upper};
    }

    Game& start(Difficulty difficulty = Difficulty::normal) {
        arena_.commit();
        Settings settings;
        settings.difficulty = difficulty;
        return game_.emplace(*rt_get_api(RT_API_VERSION), arena_.scene(), plan_, settings);
    }

    // Ticks until `done`, or so many; how often the sound was heard.
    size_t play(double seconds, TickInput input = {}, Sound sound = Sound::won,
                const std::function<bool()>& done = {}) {
        size_t heard = 0;
        for (int i = 0; i < seconds * kTicksPerSecond && !(done && done()); ++i) {
            game_->tick(input);
            heard += size_t(std::ranges::count(game_->events(), sound, &Event::sound));
        }
        return heard;
    }

    static TickInput walking(const Vec3& way, uint32_t buttons = 0) {
        TickInput input;
        input.walk[0] = float(way.x);
        input.walk[1] = float(way.z);
        for (int k = 0; k < 3; ++k) input.view[k] = float(way[k]);
        input.buttons = buttons;
        return input;
    }

    Vec3 feet() const { return game_->player().state().position; }
};

//   | wall     Two leaves close the gap; their hinges are at its ends. "use" swings them aside.
//   o
//   # <- walks
//   o
//   |
TEST_F(Round, ADoorIsInTheWayUntilItIsUsed) {
    arena_.add_box({-3.1, 0, -5}, {-2.9, 3, -0.9});
    arena_.add_box({-3.1, 0, 0.9}, {-2.9, 3, 5});
    plan_.doors = {mover({0, 0, -0.03}, {0.89, 2.9, 0.03}, {-3, 0, -0.9}),
                   mover({-0.89, 0, -0.03}, {0, 2.9, 0.03}, {-3, 0, 0.9})};
    plan_.doors[1].rest.m[0] = plan_.doors[1].rest.m[10] = -1;
    Game& game = start();
    EXPECT_FALSE(game.doors()[0].is_open());
    play(4, walking({-1, 0, 0}));
    EXPECT_NEAR(feet().x, -2.97 + 0.3, 0.02);
    EXPECT_EQ(game.status().use, Use::open_door);
    EXPECT_EQ(play(1.5, walking({0, 0, 0}, kUse), Sound::door), 1u); // once a press
    EXPECT_TRUE(game.doors()[0].is_open() && game.doors()[1].is_open());
    play(4, walking({-1, 0, 0}));
    EXPECT_LT(feet().x, -5);
}

TEST_F(Round, ALiftCarriesWhoStandsOnItAndComesBack) {
    plan_.lifts.push_back({mover({-1, -0.2, -1}, {1, 0.02, 1}), {0, 4, 0}});
    start();
    EXPECT_EQ(play(6, {}, Sound::lift), 1u);
    EXPECT_NEAR(feet().y, 4.02, 0.01);
    EXPECT_EQ(play(0.9, walking({1, 0, 0}, kRun)), 0u);
    play(2);
    EXPECT_LT(feet().y, 0.01); // jumped off
    EXPECT_EQ(play(8, {}, Sound::lift), 1u);
    const rt_mesh lift = plan_.lifts[0].part.meshes[0];
    play(4);
    const auto below = game_->world().closest({0, 3, 0}, {0, -10, 0});
    ASSERT_TRUE(below);
    EXPECT_EQ(below->mesh.index, lift.index);
    EXPECT_NEAR(below->point.y, 0.02, 0.01);
}

// Cooked for all of its fuse, then dropped at a crate's foot.
TEST_F(Round, ABlastPushesACrateToTheWall) {
    arena_.add_box({-30, 0, -7}, {30, 3, -6});
    plan_.crates.push_back(mover({-0.4, 0.0, -4.4}, {0.4, 0.8, -3.6}));
    plan_.spawns[0].feet = {0, 0, 1.5};
    Game& game = start();
    const auto front = [&] {
        const auto hit = game.world().closest({0, 0.4, 1}, {0, 0, -10}, {kSolid, {}});
        return hit ? hit->point.z : 1e9;
    };
    EXPECT_NEAR(front(), -3.6, 0.02);
    TickInput input = walking({0, 0, 0}, kThrow);
    input.view[1] = -0.35f;
    input.view[2] = -0.94f;
    play(2.4, input);
    input.buttons = 0;
    EXPECT_EQ(play(6, input, Sound::blast), 1u);
    EXPECT_LT(front(), -4.0);
    EXPECT_GT(front(), -5.25); // the wall is at -6, the crate 0.8 deep
    EXPECT_EQ(game.status().grenades, game.rules().grenades - 1);
}

// Two drones as near as each other, one behind a wall.
TEST_F(Round, ABlastDisablesWhatItSees) {
    arena_.add_box({1, 0, -12}, {1.2, 4, 1});
    arena_.add_box({-30, 0, -13}, {30, 4, -12});
    plan_.patrols = {{{-1.5, 1.8, -9}}, {{3.5, 1.8, -9}}};
    Game& game = start(Difficulty::easy);
    TickInput input = walking({0, 0, 0}, kThrow);
    input.view[1] = 0.1f;
    input.view[2] = -0.995f;
    play(1.2, input);
    input.buttons = 0;
    EXPECT_EQ(play(4, input, Sound::disabled), 1u);
    EXPECT_TRUE(game.drones()[0].is_disabled());
    EXPECT_FALSE(game.drones()[1].is_disabled());
    EXPECT_LT(game.drones()[0].position().y, 0.5);
    EXPECT_EQ(game.status().drones, 1u);
    EXPECT_EQ(game.status().score, 250u);
}

TEST_F(Round, WhoStaysInSightIsShot) {
    plan_.patrols = {{{0, 1.8, -9}, {0, 1.8, -8.9}}};
    Game& game = start();
    plan_.lamps.clear();
    const uint32_t lives = game.status().lives;
    size_t shots = 0, alarms = 0;
    for (int i = 0; i < 30 * 60 && game.status().lives == lives; ++i) {
        game.tick({});
        shots += size_t(std::ranges::count(game.events(), Sound::shot, &Event::sound));
        alarms += size_t(std::ranges::count(game.events(), Sound::alarm, &Event::sound));
    }
    EXPECT_EQ(game.status().lives, lives - 1);
    EXPECT_GE(shots, 1u);
    EXPECT_EQ(alarms, 1u);
    EXPECT_EQ(game.drones()[0].mood(), Mood::alarmed);
    play(2);
    EXPECT_EQ(game.drones()[0].mood(), Mood::calm); // it begins again
}

TEST_F(Round, BehindAWallNobodyIsSeen) {
    arena_.add_box({-5, 0, -5}, {5, 4, -4.8});
    plan_.patrols = {{{0, 1.8, -9}, {0, 1.8, -8.9}}};
    start();
    EXPECT_EQ(play(30, {}, Sound::alarm), 0u);
    EXPECT_EQ(game_->status().alarm, 0);
}

// The same drone, with a lamp above the player and without.
TEST_F(Round, LightGivesAway) {
    plan_.patrols = {{{0, 1.8, -9}, {0, 1.8, -8.9}}};
    const auto seconds_until_alarm = [&](bool lit) {
        plan_.lamps.clear();
        if (lit) plan_.lamps = {{Lamp::Kind::point, {0, 3, 0}, {0, -1, 0}, 12, 60}};
        Settings settings;
        game_.emplace(*rt_get_api(RT_API_VERSION), arena_.scene(), plan_, settings);
        play(60, {}, Sound::won, [&] { return game_->drones()[0].mood() == Mood::alarmed; });
        return game_->status().seconds;
    };
    start();
    const double dark = seconds_until_alarm(false);
    EXPECT_LT(game_->status().light, 0.6); // of the drone's beam
    const double lit = seconds_until_alarm(true);
    EXPECT_GT(game_->status().light, 0.7);
    EXPECT_LT(lit, 0.8 * dark);
    EXPECT_LT(dark, 30);
}

TEST_F(Round, ThreeCoresOpenTheGate) {
    for (const double x : {2, 4, 6}) plan_.cores.push_back({x, 1, 0});
    plan_.gates.push_back(mover({8, 0, -1}, {8.1, 2.4, 1}));
    plan_.exits = {{9.5, 0, 0}};
    arena_.add_box({8, 0, -30}, {8.1, 3, -1});
    arena_.add_box({8, 0, 1}, {8.1, 3, 30});
    Game& game = start();
    EXPECT_EQ(play(20, walking({1, 0, 0}), Sound::core), 3u);
    EXPECT_EQ(game.status().cores, 3u);
    EXPECT_EQ(game.status().outcome, Outcome::won);
    EXPECT_GT(game.status().seconds, 4.0); // the way, and the gate that rises
    EXPECT_GT(game.status().score, 3 * 1000u + 2000u);
    const uint64_t hash = game.hash();
    play(1, walking({-1, 0, 0}));
    EXPECT_EQ(game.hash(), hash); // it is over
}

TEST_F(Round, AGateStaysShutWithoutThem) {
    plan_.cores = {{2, 1, 0}, {20, 1, 20}};
    plan_.exits = {{4, 0, 0}};
    Game& game = start();
    play(10, walking({1, 0, 0}));
    EXPECT_EQ(game.status().cores, 1u);
    EXPECT_EQ(game.status().outcome, Outcome::playing);
}

TEST_F(Round, AGrenadeHeldTooLongHurts) {
    Game& game = start();
    const uint32_t lives = game.status().lives;
    EXPECT_EQ(play(4, walking({0, 0, 0}, kThrow), Sound::blast), 1u);
    EXPECT_EQ(game.status().lives, lives - 1);
    EXPECT_EQ(game.status().grenades, game.rules().grenades - 1);
}

TEST_F(Round, ThePreviewIsWhatTheGrenadeDoes) {
    arena_.add_box({-30, 0, -9}, {30, 4, -8});
    Game& game = start();
    TickInput input = walking({0, 0, 0}, kThrow);
    input.view[0] = 0.3f;
    input.view[1] = 0.3f;
    input.view[2] = -std::sqrt(1 - 0.18f);
    play(0.5, input);
    const Vec3 view(input.view[0], input.view[1], input.view[2]);
    input.buttons = 0;
    game.tick(input);
    ASSERT_EQ(game.thrown().size(), 1u);
    Vec3 last(0);
    // Thrown a tick later than it was foreseen, with a tick less of its fuse.
    play(0.5, input, Sound::won, [&] { return game.thrown().empty(); });
    ASSERT_EQ(game.thrown().size(), 1u);
    last = game.thrown()[0].ball.position();
    Game again(*rt_get_api(RT_API_VERSION), arena_.scene(), plan_, {});
    input.buttons = kThrow;
    for (int i = 0; i < 31; ++i) again.tick(input);
    const std::vector<Vec3> way = again.preview(view);
    ASSERT_GT(way.size(), 30u);
    double nearest = 1e9;
    for (const Vec3& place : way) nearest = std::min(nearest, glm::distance(place, last));
    EXPECT_LT(nearest, 0.2);
    EXPECT_TRUE(game.preview(view).empty()); // none in the hand
}

TEST_F(Round, TheVoidCostsALifeAndLeadsBack) {
    plan_.spawns[0].feet = {28, 0, 0};
    Game& game = start();
    const uint32_t lives = game.status().lives;
    play(4, walking({1, 0, 0}, kRun), Sound::won, [&] { return game.status().lives < lives; });
    EXPECT_EQ(game.status().lives, lives - 1);
    EXPECT_NEAR(feet().x, 28, 0.5);
    for (int i = 0; i < 60 * 60 && game.status().outcome == Outcome::playing; ++i)
        game.tick(walking({1, 0, 0}, kRun));
    EXPECT_EQ(game.status().outcome, Outcome::lost);
    EXPECT_EQ(game.status().lives, 0u);
}

TEST_F(Round, NoPlaceToBeginAtIsAnError) {
    plan_.spawns.clear();
    EXPECT_THROW(start(), PlanError);
}

} // namespace
} // namespace peregrine::test
