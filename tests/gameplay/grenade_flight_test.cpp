// What must hold of every throw, whatever it meets: one way at all time steps, no energy from
// nothing, never inside, always to an end.
#include "support/throws.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace peregrine::test {
namespace {

using gameplay::Grenade;
using gameplay::GrenadeRules;
using gameplay::Motion;
using gameplay::Random;

constexpr Vec3 kLower{-0.9, 1.1, -0.9}, kUpper{0.9, 2.5, 0.9}; // free room of the playground

Throw playground_throw(Random& random) {
    return random_throw(random, kLower, kUpper, 15);
}

void expect_same(const Grenade& a, const Grenade& b) {
    EXPECT_EQ(a.position(), b.position());
    EXPECT_EQ(a.velocity(), b.velocity());
    EXPECT_EQ(a.motion(), b.motion());
}

// Not near: equal, after 0.5, 1, 1.5, ... 5 s.
TEST(GrenadeFlight, IsTheSameAtAllTimeSteps) {
    Arena arena;
    add_playground(arena);
    arena.commit();
    const auto world = arena.world();
    Random random(1);
    for (const double restitution : {0.0, 0.45, 0.6, 1.0})
        for (int i = 0; i < 5; ++i) {
            const Throw thrown = playground_throw(random);
            GrenadeRules rules;
            rules.restitution = restitution;
            rules.drag = i == 4 ? 0.02 : 0;
            const auto make = [&] {
                return Grenade(world, rules, 0, thrown.position, thrown.velocity);
            };
            Grenade at_once = make(), fine = make(), usual = make(), coarse = make();
            for (int half = 1; half <= 10; ++half) {
                at_once.advance(world, half / 2.0);
                for (int k = 1; k <= 500; ++k) fine.advance(world, (500 * (half - 1) + k) / 1000.0);
                for (int k = 1; k <= 120; ++k) usual.advance(world, (120 * (half - 1) + k) / 240.0);
                for (int k = 1; k <= 15; ++k) coarse.advance(world, (15 * (half - 1) + k) / 30.0);
                expect_same(at_once, fine);
                expect_same(at_once, usual);
                expect_same(at_once, coarse);
            }
        }
}

TEST(GrenadeFlight, GainsNoEnergyAndStaysOutside) {
    Arena arena;
    add_playground(arena);
    arena.commit();
    const auto world = arena.world();
    Random random(2);
    for (int i = 0; i < 40; ++i) {
        const Throw thrown = playground_throw(random);
        GrenadeRules rules;
        rules.restitution = 0.25 * (i % 5);
        Grenade grenade(world, rules, 0, thrown.position, thrown.velocity);
        double before = energy(grenade);
        for (int tick = 1; tick <= 120 * 10; ++tick) {
            grenade.advance(world, tick / 120.0);
            const double after = energy(grenade);
            ASSERT_LE(after, before + 1e-6) << "throw " << i << ", tick " << tick;
            before = after;
            ASSERT_GE(gap(world, grenade), -2e-7) << "throw " << i << ", tick " << tick;
        }
        if (rules.restitution < 1) {
            EXPECT_EQ(grenade.motion(), Motion::resting) << "throw " << i;
        }
        EXPECT_LT(glm::length(grenade.position() / Vec3(5, 4, 5)), 2);
    }
}

TEST(GrenadeFlight, KeepsItsHeightAtRestitutionOne) {
    Arena arena;
    arena.add_floor(10);
    arena.commit();
    for (const double rate : {30.0, 60.0, 240.0}) {
        GrenadeRules rules;
        rules.restitution = 1;
        Grenade grenade(arena.world(), rules, 0, {0, 2.075, 0}, Vec3(0));
        for (int tick = 1; tick <= 60 * rate; ++tick) grenade.advance(arena.world(), tick / rate);
        const double height = energy(grenade) / 9.81 - rules.radius;
        EXPECT_NEAR(height, 2, 2e-6) << rate;
        EXPECT_GT(grenade.position().y, 0.075);
    }
}

// The heights of a bounced ball: h e^2, h e^4, ... at times that add up as a geometric series.
TEST(GrenadeFlight, BouncesWhenAndWhereItShould) {
    Arena arena;
    arena.add_floor(10);
    arena.commit();
    GrenadeRules rules;
    rules.restitution = 0.5;
    Grenade grenade(arena.world(), rules, 0, {0, 1 + rules.radius, 0}, Vec3(0));
    const double fall = std::sqrt(2 / 9.81);
    double due = fall, flight = fall;
    for (int bounce = 0; bounce < 4; ++bounce) {
        grenade.advance(arena.world(), due + 1e-3);
        ASSERT_EQ(grenade.bounces().size(), 1u);
        EXPECT_NEAR(grenade.bounces()[0].time, due, 1e-5);
        EXPECT_NEAR(grenade.bounces()[0].approach, 0.5 * 9.81 * (bounce ? flight : 2 * fall), 1e-4);
        flight = bounce ? 0.5 * flight : fall;
        due += flight;
    }
}

// Against the closed form of fall with quadratic drag: v = vt tanh(g t / vt).
TEST(GrenadeFlight, DragBringsItToItsTerminalSpeed) {
    Arena arena;
    arena.add_floor(1);
    arena.commit();
    GrenadeRules rules;
    rules.drag = 0.05;
    Grenade grenade(arena.world(), rules, 0, {0, 1000, 0}, Vec3(0));
    const double terminal = std::sqrt(9.81 / rules.drag);
    for (const double time : {0.5, 1.0, 3.0, 10.0}) {
        grenade.advance(arena.world(), time);
        EXPECT_NEAR(-grenade.velocity().y, terminal * std::tanh(9.81 * time / terminal), 1e-3);
    }
}

TEST(GrenadeFlight, IsThrownFromBehindNoWall) {
    Arena arena;
    arena.add_floor(10);
    arena.add_box({0.5, 0, -3}, {0.6, 3, 3});
    arena.commit();
    const Vec3 eye{0, 1.6, 0};
    const Vec3 beyond = gameplay::reach(arena.world(), eye, {0.9, 1.6, 0}, 0.075);
    EXPECT_NEAR(beyond.x, 0.425, 1e-5);
    EXPECT_EQ(gameplay::reach(arena.world(), eye, {0.3, 1.5, 0}, 0.075), Vec3(0.3, 1.5, 0));
}

} // namespace
} // namespace peregrine::test
