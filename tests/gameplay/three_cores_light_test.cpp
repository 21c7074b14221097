// What lights the player and what the drones make of it.
#include "gameplay/three_cores/game.h"
#include "support/arena.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

using namespace gameplay;
using namespace three_cores;

// A dark plain with somebody in its middle.
class Dark : public testing::Test {
protected:
    Arena arena_;
    Plan plan_;
    std::optional<Game> game_;

    Dark() {
        arena_.add_floor(60);
        plan_.spawns = {{{0, 0, 0}, {0, 0, -1}}};
        plan_.lower = Vec3(-60, 0, -60);
        plan_.upper = Vec3(60, 5, 60);
    }

    Game& start(Difficulty difficulty = Difficulty::normal) {
        if (!game_) arena_.commit();
        Settings settings;
        settings.difficulty = difficulty;
        return game_.emplace(*rt_get_api(RT_API_VERSION), arena_.scene(), plan_, settings);
    }

    double highest_light(double seconds, TickInput input = {}) {
        double highest = 0;
        for (int i = 0; i < seconds * kTicksPerSecond; ++i) {
            game_->tick(input);
            highest = std::max(highest, game_->status().light);
        }
        return highest;
    }
};

TEST_F(Dark, NothingShines) {
    start();
    EXPECT_EQ(highest_light(2), 0);
}

TEST_F(Dark, ABeamLightsWhomItMeets) {
    plan_.patrols = {{{0, 1.8, -6}, {0, 1.8, -5.9}}};
    start();
    EXPECT_GT(highest_light(3), 0.4);
    arena_.add_box({-5, 0, -4}, {5, 4, -3.8}); // in the way of it
    arena_.commit();
    start();
    EXPECT_EQ(highest_light(3), 0);
}

TEST_F(Dark, ADroneThatIsOutShinesOnNobody) {
    arena_.add_box({-9, 0, -9}, {9, 6, -8.8}); // lest the grenade flies past it
    plan_.patrols = {{{0, 1.8, -7}, {0, 1.8, -6.9}}};
    Game& game = start(Difficulty::easy);
    TickInput input;
    input.buttons = kThrow;
    highest_light(1.6, input);
    input.buttons = 0;
    highest_light(3, input);
    ASSERT_TRUE(game.drones()[0].is_disabled());
    highest_light(4);
    EXPECT_LT(game.status().light, 0.02);
}

TEST_F(Dark, ACoreGlows) {
    plan_.cores = {{1.8, 1, 0}};
    start();
    EXPECT_GT(highest_light(2), 0.3);
    plan_.cores = {{5, 1, 0}}; // beyond its reach
    start();
    EXPECT_EQ(highest_light(2), 0);
}

TEST_F(Dark, ABlastFlashes) {
    start();
    TickInput input;
    input.buttons = kThrow;
    input.view[1] = 0.7f;
    input.view[2] = -0.7f;
    highest_light(2, input);
    input.buttons = 0;
    EXPECT_GT(highest_light(1.6, input), 0.1);
    highest_light(3);
    EXPECT_LT(game_->status().light, 0.01);
}

// As far as a drone sees, and not farther: at each difficulty.
TEST_F(Dark, ABeamReachesAsFarAsItsDroneSees) {
    plan_.patrols = {{{0, 1.8, -40}, {0, 1.8, -39.9}}};
    for (const Difficulty difficulty : {Difficulty::easy, Difficulty::normal, Difficulty::hard}) {
        Game& game = start(difficulty);
        const std::vector<Glow> glows = game.glows();
        ASSERT_EQ(glows.size(), 1u);
        const Lamp& beam = glows[0].lamp;
        EXPECT_EQ(beam.kind, Lamp::Kind::spot);
        EXPECT_EQ(beam.radius, game.rules().sentry.range);
        EXPECT_EQ(beam.cos_outer, game.rules().sentry.cos_half_angle);
        EXPECT_EQ(beam.candela, luminance(glows[0].color));
    }
}

// The suspicion falls at once when a drone loses sight, but it stays alarmed until it forgets.
TEST_F(Dark, AnAlarmLastsUntilItIsForgotten) {
    arena_.add_box({-0.2, 0, -3}, {-0.1, 4, 3});
    plan_.spawns[0].feet = {0.5, 0, 0};
    plan_.patrols = {{{9, 1.8, 0}, {8.9, 1.8, 0}}};
    Game& game = start(Difficulty::easy);
    TickInput aside;
    aside.walk[0] = 0.01f;
    for (int i = 0; i < 20 * 60 && !game.status().alarmed; ++i) game.tick(aside);
    ASSERT_TRUE(game.status().alarmed);
    EXPECT_EQ(game.status().alarms, 1u);
    TickInput behind; // the wall
    behind.walk[1] = 1;
    behind.buttons = kRun;
    bool faded = false;
    for (int i = 0; i < 20 * 60 && game.status().alarm > 0; ++i) {
        if (i == 60) behind.walk[0] = -1, behind.walk[1] = 0;
        if (i == 100) behind.walk[0] = 0, behind.walk[1] = -1;
        if (i == 130) behind.walk[1] = 0;
        game.tick(behind);
        if (game.status().alarm == 0) break;
        EXPECT_TRUE(game.status().alarmed);
        faded |= game.status().alarm < 1;
    }
    EXPECT_TRUE(faded);
    EXPECT_FALSE(game.status().alarmed);
    EXPECT_EQ(game.status().alarms, 1u);
}

// Before the first step on easy; the others look for anybody.
TEST_F(Dark, NobodyIsHitOnEasyWhoHasNotDoneAnything) {
    plan_.lamps = {{Lamp::Kind::point, {0, 3, 0}, {0, -1, 0}, 12, 60}};
    plan_.patrols = {{{0, 1.8, -14}, {0, 1.8, -6}}};
    Game& game = start(Difficulty::easy);
    TickInput looking;
    looking.view[0] = 1;
    for (int i = 0; i < 120 * 60; ++i) game.tick(looking);
    EXPECT_EQ(game.status().lives, game.rules().lives);
    EXPECT_EQ(game.status().alarms, 0u);
    TickInput step;
    step.walk[0] = 0.5f;
    game.tick(step);
    for (int i = 0; i < 20 * 60; ++i) game.tick(looking);
    EXPECT_LT(game.status().lives, game.rules().lives);

    const uint32_t left = game.status().lives; // it waits again where the player begins again
    const uint32_t alarms = game.status().alarms;
    for (int i = 0; i < 60 * 60; ++i) game.tick(looking);
    EXPECT_EQ(game.status().lives, left);
    EXPECT_EQ(game.status().alarms, alarms);

    start(Difficulty::normal);
    for (int i = 0; i < 20 * 60; ++i) game_->tick(looking);
    EXPECT_LT(game_->status().lives, game_->rules().lives);
}

} // namespace
} // namespace peregrine::test
