// Corners, wedges, low ceilings, ledges and cracks: where a walker jitters, sticks or falls
// through.
#include "support/arena.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace peregrine::test {
namespace {

using gameplay::Character;
using gameplay::CharacterInput;

Vec3 heading(double x, double z) {
    const double length = std::sqrt(x * x + z * z);
    return {x / length, 0, z / length};
}

// Pushes for ten seconds, then expects the state to be the same after each further step.
void expect_rest(Character& character, const Vec3& walk) {
    run(character, {.walk = walk}, 600);
    const Vec3 rest = character.state().position;
    double moved = 0;
    for (int i = 0; i < 300; ++i) {
        run(character, {.walk = walk}, 1);
        moved = std::max(moved, glm::length(character.state().position - rest));
    }
    EXPECT_LT(moved, 1e-6) << "towards " << walk.x << ", " << walk.z;
    EXPECT_TRUE(character.state().grounded);
}

//     _______
//           |
//      ( )->|     from above
//       ´ ` |
TEST(CharacterCorner, ComesToRestInACorner) {
    Arena arena;
    arena.add_floor(10);
    arena.add_box({2, -1, -9}, {3, 3, 9});
    arena.add_box({-9, -1, 2}, {9, 3, 3});
    arena.commit();
    for (const double z : {0.1, 0.5, 1.0, 2.0, 9.0}) {
        Character character = standing(arena.world(), {0, 0, 0});
        expect_rest(character, heading(1, z));
        EXPECT_NEAR(character.state().position.x, 1.7, 0.01) << z;
        EXPECT_NEAR(character.state().position.z, 1.7, 0.01) << z;
    }
}

//     \     /
//      \   /      two walls, from above, at an acute angle
//       \ /
TEST(CharacterCorner, ComesToRestInAnAcuteWedge) {
    for (const double half_width : {0.1, 0.3, 0.7, 1.5})
        for (const double lean : {-0.2, 0.0, 0.05}) {
            Arena arena;
            arena.add_floor(12);
            for (const double side : {-1.0, 1.0}) {
                const Vec3 far(-6, 0, 6 * half_width * side), up(0, 3, 0), down(0, -1, 0);
                arena.add_quad(down, up, far + up, far + down);
            }
            arena.commit();
            Character character = standing(arena.world(), {-5, 0, 0});
            expect_rest(character, heading(1, lean));
            const Vec3 rest = character.state().position;
            const double gap =
                (-rest.x * half_width - std::fabs(rest.z)) / std::sqrt(1 + half_width * half_width);
            EXPECT_GE(gap, 0.3) << half_width;
            if (lean == 0.0) {
                EXPECT_LT(gap, 0.31) << half_width;
            }
        }
}

//      \   /      a valley between two slopes of 45 degrees: walks in, along and out;
//       \ /       of 65 degrees: stands wedged in it
TEST(CharacterCorner, StandsBetweenTwoSlopes) {
    for (const double rise : {1.0, 2.1}) {
        Arena arena;
        for (const double side : {-1.0, 1.0})
            arena.add_quad({0, 0, -20}, {0, 0, 20}, {side * 5, rise * 5, 20},
                           {side * 5, rise * 5, -20});
        arena.commit();
        Character character = standing(arena.world(), {0.8, 3, 0});
        run(character, {}, 240);
        EXPECT_TRUE(character.state().grounded) << rise;
        const uint64_t before = hash(character.state());
        run(character, {}, 120);
        EXPECT_EQ(hash(character.state()), before) << rise;

        const double start = character.state().position.z;
        run(character, {.walk = {0, 0, 1}}, 120);
        EXPECT_NEAR(character.state().position.z - start, 8, 0.4) << rise;
        run(character, {.walk = {1, 0, 0}}, 60);
        if (rise == 1.0)
            EXPECT_GT(character.state().position.y, 2);
        else
            EXPECT_LT(character.state().position.y, 1);
    }
}

//     ______________
//      ( )->  `-.        a ceiling that gets lower
//     ____________`-.
TEST(CharacterCorner, StopsUnderALoweringCeiling) {
    for (const double low : {0.2, 1.0, 1.7}) {
        Arena arena;
        arena.add_floor(20);
        arena.add_quad({0, 3, -5}, {10, low, -5}, {10, low, 5}, {0, 3, 5});
        arena.commit();
        Character character = standing(arena.world(), {-1, 0, 0});
        expect_rest(character, {1, 0, 0});
        EXPECT_GT(character.state().position.x, 1) << low;
        EXPECT_NEAR(character.state().position.y, 0, 1e-4) << low;
        EXPECT_FALSE(arena.world().overlaps(character.capsule())) << low;
    }
}

//          ____
//         |____|         a step of 0.2 m into a doorway that is higher than the body by less than
//      ( )  __________   what a lift for the highest step takes
//     __´__|
TEST(CharacterCorner, StepsUpUnderALintel) {
    for (const double room : {0.03, 0.1, 0.2})
        for (const double edge : {1.9, 2.0, 2.1}) {
            Arena arena;
            arena.add_floor(20);
            arena.add_box({2, -1, -5}, {9, 0.2, 5});
            arena.add_box({edge, 2.0 + room, -5}, {5, 4, 5});
            arena.commit();
            Character character = standing(arena.world(), {0, 0, 0});
            run(character, {.walk = {1, 0, 0}}, 120);
            EXPECT_GT(character.state().position.x, 6) << room << ' ' << edge;
            EXPECT_NEAR(character.state().position.y, 0.2, 1e-3) << room << ' ' << edge;
        }
}

//       ( )
//     ___´___ ___        a floor of strips with cracks narrower than the body, and a seam that a
//                        step of time ends on exactly
TEST(CharacterCorner, WalksOverCracks) {
    for (const double crack : {0.0, 0.01, 0.1, 0.3}) {
        Arena arena;
        for (int i = -10; i < 10; ++i)
            arena.add_quad({i, 0, -9}, {i, 0, 9}, {i + 1 - crack, 0, 9}, {i + 1 - crack, 0, -9});
        arena.commit();
        Character character = standing(arena.world(), {-8.5, 0.01, 0});
        double lowest = 0;
        for (int i = 0; i < 240; ++i) {
            run(character, {.walk = heading(1, 0.1)}, 1);
            ASSERT_TRUE(character.state().grounded) << crack;
            lowest = std::min(lowest, character.state().position.y);
        }
        EXPECT_GT(character.state().position.x, 7) << crack;
        // Half the crack is a chord of the round end.
        EXPECT_GE(lowest, std::sqrt(0.09 - 0.25 * crack * crack) - 0.3 - 2e-3) << crack;
    }
}

TEST(CharacterCorner, NeverFallsThroughSeams) {
    Arena arena;
    for (int i = -20; i < 20; ++i) // long slivers that all meet in two points
        arena.add_triangle({0, 0, -10}, {i * 0.5 + 0.5, 0, 10}, {i * 0.5, 0, 10});
    arena.commit();
    for (int i = -8; i <= 8; ++i) {
        Character character = standing(arena.world(), {i * 0.5, 2, 9.9});
        run(character, {.walk = heading(-i * 0.5, -19.9)}, 240);
        EXPECT_NEAR(character.state().position.y, 0, 1e-4) << i;
    }
}

//      ( )
//       |         stands on the top of a wall of 5 cm, and walks along it
TEST(CharacterCorner, BalancesOnAThinLedge) {
    Arena arena;
    arena.add_floor(20);
    arena.add_box({-10, -1, -0.025}, {10, 2, 0.025});
    arena.commit();
    Character character = standing(arena.world(), {-5, 2, 0});
    EXPECT_TRUE(character.state().grounded);
    run(character, {.walk = {1, 0, 0}}, 120);
    EXPECT_GT(character.state().position.x, 2);
    EXPECT_NEAR(character.state().position.y, 2, 1e-4);
    run(character, {.walk = {0, 0, 1}}, 120);
    EXPECT_NEAR(character.state().position.y, 0, 1e-4);
}

// A corridor that is hardly wider than the body lets it through; a narrower one does not.
TEST(CharacterCorner, FitsWhereItFits) {
    for (const double width : {0.59, 0.602, 0.61, 0.7}) {
        Arena arena;
        arena.add_floor(20);
        arena.add_box({0, -1, 0.5 * width}, {4, 3, 9});
        arena.add_box({0, -1, -9}, {4, 3, -0.5 * width});
        arena.commit();
        Character character = standing(arena.world(), {-2, 0, 0});
        run(character, {.walk = {1, 0, 0}}, 180);
        if (width < 0.6)
            EXPECT_LT(character.state().position.x, 0) << width;
        else
            EXPECT_GT(character.state().position.x, 5) << width;
    }
}

} // namespace
} // namespace peregrine::test
