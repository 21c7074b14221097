// Jumping, crouching, riding and being pushed.
#include "support/arena.h"

#include <gtest/gtest.h>

#include <cmath>

namespace peregrine::test {
namespace {

using gameplay::Character;
using gameplay::CharacterInput;
using gameplay::MeshMotion;

constexpr double kStep = 1.0 / 60;

TEST(CharacterJump, IsAsHighAtEveryTimeStep) {
    Arena arena;
    arena.add_floor(10);
    arena.commit();
    for (const int rate : {30, 60, 144, 500}) {
        Character character = standing(arena.world(), {0, 0, 0});
        double highest = 0;
        run(character, {.jump = true}, 1, 1.0 / rate);
        for (int i = 0; i < rate; ++i) {
            run(character, {}, 1, 1.0 / rate);
            highest = std::max(highest, character.state().position.y);
        }
        EXPECT_NEAR(highest, 4.5 * 4.5 / (2 * 9.81), 0.006) << rate;
        EXPECT_TRUE(character.state().grounded) << rate;
        EXPECT_NEAR(character.state().position.y, 0, 1e-5) << rate;
    }
}

TEST(CharacterWalkRate, GoesAsFarAtEveryTimeStep) {
    Arena arena;
    arena.add_floor(20);
    for (int i = 0; i < 8; ++i) arena.add_box({2 + 0.3 * i, -1, -2}, {30, 0.2 * (i + 1), 2});
    arena.commit();
    for (const int rate : {30, 60, 144}) {
        Character character = standing(arena.world(), {0, 0, 0});
        run(character, {.walk = {1, 0, 0}}, 2 * rate, 1.0 / rate);
        EXPECT_NEAR(character.state().position.x, 7.85, 0.15) << rate;
        EXPECT_NEAR(character.state().position.y, 1.6, 1e-3) << rate;
    }
}

//     ________  2.1 m
//       (^)           the head stops at the ceiling and comes down at once
//     __( )___
TEST(CharacterJump, BumpsItsHead) {
    Arena arena;
    arena.add_floor(10);
    arena.add_floor(10, 2.1);
    arena.commit();
    Character character = standing(arena.world(), {0, 0, 0});
    double highest = 0;
    run(character, {.jump = true}, 1);
    int steps = 0;
    for (; steps < 120 && !character.state().grounded; ++steps) {
        run(character, {}, 1);
        highest = std::max(highest, character.state().position.y);
    }
    EXPECT_GT(highest, 0.29);
    EXPECT_LE(highest + 1.8, 2.1);
    EXPECT_LT(steps, 25); // half a second and more without the ceiling
}

//     ( )           jumps at a ledge that is a little too high, and does not get up by its side
//     _( )|
TEST(CharacterJump, CatchesNoLedgeWithItsSide) {
    for (const double height : {0.9, 1.0, 1.22, 1.28}) {
        Arena arena;
        arena.add_floor(20);
        arena.add_box({1, -1, -5}, {20, height, 5});
        arena.commit();
        Character character = standing(arena.world(), {0.5, 0, 0});
        run(character, {.walk = {1, 0, 0}, .jump = true}, 1);
        run(character, {.walk = {1, 0, 0}}, 120);
        EXPECT_NEAR(character.state().position.y, height < 1.1 ? height : 0, 0.002) << height;
    }
}

//      ______       crawls into a duct of 1.2 m, and gets up behind it alone
//     |
//      ( ) _____
TEST(CharacterCrouch, GetsUpOnlyWhereThereIsRoom) {
    Arena arena;
    arena.add_floor(20);
    arena.add_box({0, 1.2, -5}, {3, 4, 5});
    arena.commit();
    Character character = standing(arena.world(), {-2, 0, 0});
    run(character, {.walk = {1, 0, 0}}, 60);
    EXPECT_LT(character.state().position.x, 0);
    run(character, {.walk = {1, 0, 0}, .crouch = true}, 60);
    EXPECT_GT(character.state().position.x, 0.5);
    run(character, {}, 30); // wants to get up
    EXPECT_EQ(character.state().height, 1.0);
    EXPECT_FALSE(arena.world().overlaps(character.capsule()));
    run(character, {.walk = {1, 0, 0}}, 120);
    EXPECT_GT(character.state().position.x, 3);
    EXPECT_EQ(character.state().height, 1.8);
    EXPECT_NEAR(character.state().position.y, 0, 1e-4);
}

//       ( )
//     [-----]  ^     up, down and aside, told of the motion and not
TEST(CharacterRide, StaysOnALift) {
    for (const bool told : {true, false})
        for (const double speed : {0.5, 3.0}) {
            Arena arena;
            arena.add_floor(20);
            const rt_mesh lift = arena.add_mover({-1, 0, -1}, {1, 0.2, 1});
            arena.commit();
            Character character = standing(arena.world(), {0, 0.2, 0});
            for (int i = 0; i < 240; ++i) {
                const double way = (i < 120 ? speed : -speed) * kStep;
                const MeshMotion motion = arena.shift(lift, {0, way, 0});
                CharacterInput input;
                if (told) input.motions = {&motion, 1};
                run(character, input, 1);
                ASSERT_TRUE(character.state().grounded) << i;
                const double top = 0.2 + speed * kStep * (i < 120 ? i + 1 : 239 - i);
                ASSERT_NEAR(character.state().position.y, top, 3e-3) << i << " told " << told;
            }
        }
}

TEST(CharacterRide, IsCarriedAsideAndTurned) {
    Arena arena;
    arena.add_floor(30, -5);
    const rt_mesh raft = arena.add_mover({-2, 0, -2}, {2, 0.2, 2});
    arena.commit();
    Character character = standing(arena.world(), {0.5, 0.2, 0.5});
    for (int i = 0; i < 120; ++i) {
        const MeshMotion motion = arena.shift(raft, {2 * kStep, 0, kStep});
        run(character, {.motions = {&motion, 1}}, 1);
    }
    EXPECT_NEAR(character.state().position.x, 4.5, 1e-3);
    EXPECT_NEAR(character.state().position.z, 2.5, 1e-3);
    EXPECT_EQ(character.state().velocity, Vec3(0)); // relative to the raft

    // It jumps with the speed of the raft, and lands where it stood on it.
    const MeshMotion step = arena.shift(raft, {2 * kStep, 0, kStep});
    run(character, {.jump = true, .motions = {&step, 1}}, 1);
    for (int i = 0; i < 90; ++i) {
        const MeshMotion motion = arena.shift(raft, {2 * kStep, 0, kStep});
        run(character, {.motions = {&motion, 1}}, 1);
    }
    EXPECT_TRUE(character.state().grounded);
    EXPECT_NEAR(character.state().position.x, 0.5 + 2 * kStep * 211, 0.05);

    // A quarter turn about the raft's middle.
    const Vec3 middle(2 * kStep * 211, 0, kStep * 211);
    const Vec3 arm = character.state().position - middle;
    double sine = 0, cosine = 1;
    for (int i = 0; i < 90; ++i) {
        // The turn of one degree, again and again.
        const double s = 0.01745240643728351, c = 0.9998476951563913;
        const double next = sine * c + cosine * s;
        cosine = cosine * c - sine * s;
        sine = next;
        rt_transform to = turned({0, 0, 0}, sine, cosine);
        to.m[3] = middle.x;
        to.m[11] = middle.z;
        const MeshMotion motion = arena.move(raft, to);
        run(character, {.motions = {&motion, 1}}, 1);
    }
    EXPECT_NEAR(character.state().position.x, middle.x + arm.z, 0.01);
    EXPECT_NEAR(character.state().position.z, middle.z - arm.x, 0.01);
}

//     ______
//     [lift]  v     comes down on the head: squeezed, never under the floor
//      ( )
TEST(CharacterPush, IsSqueezedNotBuried) {
    Arena arena;
    arena.add_floor(10);
    const rt_mesh press = arena.add_mover({-2, 3.005, -2}, {2, 3.5, 2});
    arena.commit();
    Character character = standing(arena.world(), {0, 0, 0});
    bool squeezed = false;
    for (int i = 0; i < 80; ++i) {
        arena.shift(press, {0, -kStep, 0});
        run(character, {}, 1);
        EXPECT_EQ(character.state().squeezed, uint32_t(3.005 - (i + 1) * kStep < 1.8)) << i;
        squeezed |= character.state().squeezed != 0;
        EXPECT_NEAR(character.state().position.y, 0, 0.01);
    }
    EXPECT_TRUE(squeezed);
}

//          |         a door that swings by a quarter takes along who stands in its way
//     hinge+---( )
TEST(CharacterPush, GivesWayToADoor) {
    Arena arena;
    arena.add_floor(10);
    const rt_mesh door = arena.add_mover({0, 0.01, -0.03}, {1, 2.1, 0.03});
    arena.commit();
    Character character = standing(arena.world(), {0.6, 0, 0.4});
    double sine = 0, cosine = 1;
    const double s = -0.01745240643728351, c = 0.9998476951563913; // a degree
    for (int i = 0; i < 90; ++i) {
        const double next = sine * c + cosine * s;
        cosine = cosine * c - sine * s;
        sine = next;
        arena.move(door, turned({0, 0, 0}, sine, cosine));
        run(character, {}, 1);
        EXPECT_FALSE(character.state().squeezed) << i;
    }
    EXPECT_FALSE(arena.world().overlaps(character.capsule()));
    EXPECT_LT(character.state().position.x, 0);
    EXPECT_NEAR(character.state().position.y, 0, 1e-4);
    const Vec3 rest = character.state().position;
    run(character, {}, 60);
    EXPECT_EQ(character.state().position, rest);
}

TEST(CharacterPush, IsPushedAheadByAWall) {
    Arena arena;
    arena.add_floor(20);
    const rt_mesh wall = arena.add_mover({-2, 0.05, -2}, {-1, 2, 2});
    arena.commit();
    Character character = standing(arena.world(), {0, 0, 0});
    for (int i = 0; i < 180; ++i) {
        arena.shift(wall, {3 * kStep, 0, 0});
        run(character, {}, 1);
        const double face = -1 + 3 * kStep * (i + 1);
        ASSERT_GE(character.state().position.x, face + 0.3) << i;
        ASSERT_LE(character.state().position.x, std::max(0.0, face + 0.31)) << i;
        ASSERT_TRUE(character.state().grounded);
    }
}

} // namespace
} // namespace peregrine::test
