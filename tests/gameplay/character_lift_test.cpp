// Jumping off what moves, and being caught by what rises.
#include "support/arena.h"

#include <gtest/gtest.h>

#include <cmath>

namespace peregrine::test {
namespace {

using gameplay::Character;
using gameplay::CharacterInput;
using gameplay::MeshMotion;

constexpr double kJump = 4.5, kGravity = 9.81;
constexpr double kTop = kJump * kJump / (2 * kGravity), kAloft = 2 * kJump / kGravity;

struct Flight {
    double highest = -1;  // m above where it stood on the mover
    double aside = 0;     // m, horizontally from there, at the end
    double aloft = 0;     // s
    double landed_at = 0; // m above where it stood, at the end
};

//      ( )        A wide platform goes with a steady velocity; who stands on it jumps straight up.
//    [-----] ->   What is measured is relative to it.
Flight jump_from(const Vec3& velocity, int rate, int ticks_before = 3) {
    const double tick = 1.0 / rate;
    Arena arena;
    const rt_mesh lift = arena.add_mover({-3, -0.2, -3}, {3, 0, 3});
    arena.commit();
    Character character = standing(arena.world(), {0, 0, 0});
    const auto go = [&](bool jump) {
        const MeshMotion motion = arena.shift(lift, velocity * tick);
        CharacterInput input;
        input.jump = jump;
        input.motions = {&motion, 1};
        character.update(input, tick);
    };
    for (int i = 0; i < ticks_before; ++i) go(false);
    EXPECT_TRUE(character.state().grounded);
    const double level = character.state().position.y - ticks_before * tick * velocity.y;
    Flight flight;
    for (int i = 0; i < 2 * kAloft * rate; ++i) {
        go(i == 0);
        const Vec3 passed = double(ticks_before + i + 1) * tick * velocity;
        const Vec3 at = character.state().position - passed;
        flight.highest = std::max(flight.highest, at.y - level);
        flight.aside = std::hypot(at.x, at.z);
        flight.landed_at = at.y - level;
        if (!character.state().grounded) flight.aloft = (i + 1) * tick;
    }
    EXPECT_TRUE(character.state().grounded);
    return flight;
}

TEST(CharacterLift, AJumpIsAsHighAsFromTheFloor) {
    for (const int rate : {30, 60, 144})
        for (const double speed : {0.0, -0.5, -1.4, -3.0, -4.4, -4.6, -8.0, -12.0, -20.0, 0.5, 1.4,
                                   3.0, 4.4, 6.0, 12.0, 20.0}) {
            SCOPED_TRACE(std::to_string(speed) + " m/s at " + std::to_string(rate));
            const Flight flight = jump_from({0, speed, 0}, rate);
            // The top may lie between two ticks.
            EXPECT_LE(flight.highest, kTop + 1e-9);
            EXPECT_GE(flight.highest, kTop - kGravity / (8.0 * rate * rate) - 1e-9);
            EXPECT_NEAR(flight.aloft, kAloft, 1.5 / rate);
            EXPECT_NEAR(flight.landed_at, 0, 1e-4);
            EXPECT_NEAR(flight.aside, 0, 1e-6);
        }
}

TEST(CharacterLift, AJumpFromARaftComesDownWhereItBegan) {
    for (const int rate : {30, 60, 144})
        for (const double speed : {0.5, 3.0, 12.0})
            for (const Vec3& way :
                 {Vec3(1, 0, 0), Vec3(-0.6, 0, 0.8), Vec3(0.48, 0.6, -0.64), Vec3(0.6, -0.8, 0)}) {
                SCOPED_TRACE(std::to_string(speed) + " m/s at " + std::to_string(rate));
                const Flight flight = jump_from(speed * way, rate);
                EXPECT_NEAR(flight.highest, kTop, 0.5 * kGravity / (rate * rate) + 1e-3);
                EXPECT_NEAR(flight.aside, 0, 1e-3);
                EXPECT_NEAR(flight.aloft, kAloft, 1.5 / rate);
            }
}

// A turning disc gives the speed of its rim.
TEST(CharacterLift, AJumpFromATurningDiscGoesStraightOn) {
    Arena arena;
    arena.add_floor(30, -5);
    const rt_mesh disc = arena.add_mover({-4, -0.2, -4}, {4, 0, 4});
    arena.commit();
    Character character = standing(arena.world(), {2, 0, 0});
    double angle = 0;
    const double step = 0.02; // radians a tick
    const auto go = [&](bool jump) {
        angle += step;
        const MeshMotion motion =
            arena.move(disc, turned({0, 0, 0}, std::sin(angle), std::cos(angle)));
        CharacterInput input;
        input.jump = jump;
        input.motions = {&motion, 1};
        character.update(input, 1.0 / 60);
    };
    for (int i = 0; i < 10; ++i) go(false);
    const Vec3 from = character.state().position;
    go(true);
    const Vec3 first = character.state().position - from;
    EXPECT_NEAR(std::hypot(first.x, first.z), 2 * step, 1e-4);
    for (int i = 1; i < 20; ++i) go(false);
    const Vec3 way = character.state().position - from;
    EXPECT_NEAR(way.x, 20 * first.x, 1e-3);
    EXPECT_NEAR(way.z, 20 * first.z, 1e-3);
}

//      ( ) ^      A lift that rises faster than the jump that it follows.
//    [-----] ^
TEST(CharacterLift, WhatRisesFasterCatchesIt) {
    for (const double speed : {5.0, 12.0}) {
        Arena arena;
        const rt_mesh lift = arena.add_mover({-3, -0.2, -3}, {3, 0, 3});
        arena.commit();
        Character character = standing(arena.world(), {0, 0, 0});
        character.update({.jump = true}, 1.0 / 60);
        int caught = 0;
        for (int i = 0; i < 60 && !caught; ++i) {
            const MeshMotion motion = arena.shift(lift, {0, speed / 60, 0});
            character.update({.motions = {&motion, 1}}, 1.0 / 60);
            if (character.state().grounded) caught = i + 1;
        }
        // It is 0.07 m up when the lift sets out, with 0.08 or 0.2 m a tick.
        EXPECT_GE(caught, 1);
        EXPECT_LE(caught, 6) << speed;
        EXPECT_EQ(character.state().velocity, Vec3(0));
    }
}

// Its own speed is relative to what carries it; in the world the mover's is added.
TEST(CharacterLift, ItsVelocityInTheWorldIsThatOfItsGround) {
    Arena arena;
    const rt_mesh lift = arena.add_mover({-9, -0.2, -9}, {9, 0, 9});
    arena.commit();
    Character character = standing(arena.world(), {0, 0, 0});
    for (int i = 0; i < 30; ++i) {
        const MeshMotion motion = arena.shift(lift, {0.05, -0.02, 0});
        const CharacterInput input{.walk = {0, 0, 1}, .motions = {&motion, 1}};
        character.update(input, 1.0 / 60);
        const Vec3 velocity = character.world_velocity(input.motions, 1.0 / 60);
        EXPECT_NEAR(velocity.x, 3, 1e-9);
        EXPECT_NEAR(velocity.y, -1.2, 1e-9);
        EXPECT_EQ(velocity.z, character.state().velocity.z);
    }
    const MeshMotion motion = arena.shift(lift, {0.05, -0.02, 0});
    character.update({.jump = true, .motions = {&motion, 1}}, 1.0 / 60);
    EXPECT_EQ(character.world_velocity({&motion, 1}, 1.0 / 60), character.state().velocity);
}

} // namespace
} // namespace peregrine::test
