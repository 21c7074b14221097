// Walking: floors, walls, steps, slopes.
#include "support/arena.h"

#include <gtest/gtest.h>

#include <cmath>

namespace peregrine::test {
namespace {

using gameplay::Character;
using gameplay::CharacterInput;
using gameplay::CharacterRules;

const CharacterInput kEast{.walk = {1, 0, 0}};
const CharacterInput kWest{.walk = {-1, 0, 0}};

double skin_of(const Character& character) {
    return character.rules().skin;
}

TEST(CharacterWalk, StandsOnAFloorToTheBit) {
    Arena arena;
    arena.add_floor(10);
    arena.commit();
    Character character = standing(arena.world(), {0.3, 0.5, 0.2});
    EXPECT_TRUE(character.state().grounded);
    EXPECT_NEAR(character.state().position.y, 0, 1e-5);
    const uint64_t before = hash(character.state());
    run(character, {}, 600);
    EXPECT_EQ(hash(character.state()), before);
}

TEST(CharacterWalk, GoesAsFastAsTheRulesSay) {
    Arena arena;
    arena.add_floor(20);
    arena.commit();
    Character character = standing(arena.world(), {0, 0, 0});
    run(character, kEast, 60);
    const double start = character.state().position.x;
    run(character, kEast, 60);
    EXPECT_NEAR(character.state().position.x - start, 4, 1e-6);
    EXPECT_NEAR(character.state().position.y, 0, 1e-5);
    run(character, {}, 60);
    EXPECT_EQ(character.state().velocity, Vec3(0));
}

//      ( )->|      walks into the wall at 45 degrees, goes on along it at the speed that is left
//     ______|
TEST(CharacterWalk, SlidesAlongAWall) {
    Arena arena;
    arena.add_floor(30);
    arena.add_box({2, -1, -20}, {3, 3, 20});
    arena.commit();
    Character character = standing(arena.world(), {0, 0, -10});
    const double half = std::sqrt(0.5);
    run(character, {.walk = {half, 0, half}}, 120);
    const Vec3 start = character.state().position;
    run(character, {.walk = {half, 0, half}}, 60);
    EXPECT_NEAR(character.state().position.x, 2 - 0.3 - skin_of(character), 1e-3);
    EXPECT_LE(character.state().position.x, 2 - 0.3);
    EXPECT_NEAR(character.state().position.z - start.z, 4 * half, 0.05);
}

//                      ____
//                 ____|        up and down again
//            ____|  0.3
//     ______| 0.25
void climb_stairs(double riser, double tread) {
    constexpr int kSteps = 10;
    Arena arena;
    arena.add_floor(40);
    for (int i = 0; i < kSteps; ++i)
        arena.add_box({2 + i * tread, -1, -2}, {2 + kSteps * tread + 5, (i + 1) * riser, 2});
    arena.commit();
    Character character = standing(arena.world(), {0, 0, 0});
    double rise = 0; // the largest in a step of time
    for (int i = 0; i < 60 * 8 && character.state().position.x < 2 + kSteps * tread + 2; ++i) {
        const double before = character.state().position.y;
        run(character, kEast, 1);
        ASSERT_TRUE(character.state().grounded) << "at x = " << character.state().position.x;
        rise = std::max(rise, character.state().position.y - before);
    }
    EXPECT_NEAR(character.state().position.y, kSteps * riser, 1e-4);
    EXPECT_LT(rise, riser + 0.02);
    for (int i = 0; i < 60 * 8 && character.state().position.x > 1; ++i) {
        run(character, kWest, 1);
        ASSERT_TRUE(character.state().grounded) << "at x = " << character.state().position.x;
    }
    run(character, {}, 10);
    EXPECT_NEAR(character.state().position.y, 0, 1e-4);
}

TEST(CharacterWalk, ClimbsStairs) {
    climb_stairs(0.15, 0.3);
    climb_stairs(0.25, 0.3);
    climb_stairs(0.35, 0.3);
    climb_stairs(0.2, 0.2);
}

TEST(CharacterWalk, ClimbsNoStepAboveTheLimit) {
    for (const double height : {0.2, 0.34, 0.37, 0.5, 0.6}) {
        Arena arena;
        arena.add_floor(40);
        arena.add_box({2, -1, -5}, {40, height, 5});
        arena.commit();
        for (const double wish : {1.0, 0.3}) {
            Character character = standing(arena.world(), {0, 0, 0});
            run(character, {.walk = {wish, 0, 0.05}}, 300);
            if (height < 0.35)
                EXPECT_NEAR(character.state().position.y, height, 1e-4) << height;
            else
                EXPECT_NEAR(character.state().position.y, 0, 1e-4) << height;
        }
    }
}

//            .´        an endless ramp at `degrees`
//         .´
//     __.´
struct Ramp {
    explicit Ramp(double degrees) {
        const double angle = degrees / 180 * 3.14159265358979;
        const Vec3 up(20 * std::cos(angle), 20 * std::sin(angle), 0);
        arena.add_quad({-20, 0, 10}, {0, 0, 10}, {0, 0, -10}, {-20, 0, -10});
        arena.add_quad({0, 0, 10}, Vec3{0, 0, 10} + up, Vec3{0, 0, -10} + up, {0, 0, -10});
        arena.commit();
        tangent = up.y / up.x;
    }
    Arena arena;
    double tangent;
};

TEST(CharacterWalk, WalksSlopesBelowTheLimit) {
    for (const double degrees : {5.0, 20.0, 35.0, 45.0, 49.0}) {
        Ramp ramp(degrees);
        Character character = standing(ramp.arena.world(), {-1, 0, 0});
        for (int i = 0; i < 100; ++i) {
            run(character, kEast, 1);
            ASSERT_TRUE(character.state().grounded) << degrees;
        }
        const Vec3 top = character.state().position;
        EXPECT_GT(top.x, 4) << degrees;
        EXPECT_NEAR(top.y,
                    (top.x + 0.3 * ramp.tangent / std::hypot(1, ramp.tangent)) * ramp.tangent
                        - 0.3 * (1 - 1 / std::hypot(1, ramp.tangent)),
                    0.01)
            << degrees;

        run(character, {}, 20); // stands still
        const uint64_t before = hash(character.state());
        run(character, {}, 300);
        EXPECT_EQ(hash(character.state()), before) << degrees;

        for (int i = 0; i < 100; ++i) {
            run(character, kWest, 1);
            ASSERT_TRUE(character.state().grounded) << degrees;
        }
    }
}

TEST(CharacterWalk, SlidesDownSlopesAboveTheLimit) {
    for (const double degrees : {51.0, 60.0, 75.0}) {
        Ramp ramp(degrees);
        Character character = standing(ramp.arena.world(), {-1, 0, 0});
        run(character, kEast, 200);
        EXPECT_LT(character.state().position.y, 0.02) << degrees;
        EXPECT_LT(character.state().position.x, 0) << degrees;

        character.place({3, 3 * ramp.tangent + 1, 0});
        run(character, kEast, 240);
        EXPECT_LT(character.state().position.y, 0.02) << degrees;
        EXPECT_TRUE(character.state().grounded) << degrees;
    }
}

TEST(CharacterWalk, FallsOffALedgeAndLands) {
    Arena arena;
    arena.add_floor(30);
    arena.add_box({-5, 0, -5}, {0, 2, 5});
    arena.commit();
    Character character = standing(arena.world(), {-2, 2, 0});
    EXPECT_NEAR(character.state().position.y, 2, 1e-5);
    bool flew = false;
    for (int i = 0; i < 120; ++i) {
        run(character, kEast, 1);
        flew |= !character.state().grounded;
    }
    EXPECT_TRUE(flew);
    EXPECT_TRUE(character.state().grounded);
    EXPECT_NEAR(character.state().position.y, 0, 1e-5);
}

} // namespace
} // namespace peregrine::test
