// On the ground: no bumps where none are, slopes, edges, and ground that moves.
#include "support/throws.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace peregrine::test {
namespace {

using gameplay::Grenade;
using gameplay::GrenadeRules;
using gameplay::Motion;

// A flat grid of triangles, a metre a cell: a ball must not feel their edges.
TEST(GrenadeRoll, FeelsNoEdgesInAFlatFloor) {
    for (const double height : {0.0, 0.1, 12.3}) {
        Arena arena;
        for (int x = -30; x < 30; ++x)
            for (int z = -3; z < 3; ++z)
                arena.add_quad({x, height, z}, {x, height, z + 1}, {x + 1, height, z + 1},
                               {x + 1, height, z});
        arena.commit();
        const double level = double(float(height)) + 0.075;
        for (const double speed : {5.0, 20.0})
            for (const double friction : {0.0, 0.5}) {
                GrenadeRules rules;
                rules.friction = friction;
                rules.rolling_friction = 0;
                const Vec3 velocity{speed, 0, 0.03 * speed};
                Grenade grenade(arena.world(), rules, 0, {-25.3, level, 0.2}, velocity);
                for (int tick = 1; tick <= 120; ++tick) {
                    grenade.advance(arena.world(), tick / 60.0);
                    ASSERT_NEAR(grenade.position().y, level, 2e-6);
                }
                // Gripping the ground takes 2/7 of the speed, and nothing else takes any.
                const double left = friction > 0 ? 5.0 / 7 : 1;
                EXPECT_NEAR(grenade.velocity().x, left * speed, 1e-4 * speed);
            }
    }
}

// Down a slope a ball gains 5/7 of what gravity pulls along it.
TEST(GrenadeRoll, RollsDownASlope) {
    Arena arena;
    const double sine = 0.28, cosine = 0.96; // of the slope
    arena.add_quad({-50 * cosine, 50 * sine, -5}, {-50 * cosine, 50 * sine, 5},
                   {50 * cosine, -50 * sine, 5}, {50 * cosine, -50 * sine, -5});
    arena.commit();
    GrenadeRules rules;
    rules.rolling_friction = 0.05;
    Grenade grenade(arena.world(), rules, 0, Vec3(sine, cosine, 0) * 0.075, Vec3(0));
    grenade.advance(arena.world(), 2);
    const double acceleration = 9.81 * (5.0 / 7 * sine - rules.rolling_friction * cosine);
    EXPECT_NEAR(glm::length(grenade.velocity()), 2 * acceleration, 2e-3);
    EXPECT_NEAR(glm::length(grenade.position()), 2 * acceleration, 5e-2);
    EXPECT_NEAR(gap(arena.world(), grenade), 1e-6, 5e-7);
}

TEST(GrenadeRoll, StopsWhereFrictionHoldsIt) {
    Arena arena;
    arena.add_quad({-50, 2, -50}, {-50, 2, 50}, {50, -2, 50}, {50, -2, -50}); // 1 in 25
    arena.commit();
    GrenadeRules rules;
    rules.rolling_friction = 0.1;
    Grenade grenade(arena.world(), rules, 0, {0, 0.075 * std::sqrt(1 + 0.0016), 0}, {2, 0, 1});
    double stopped = 0;
    for (int tick = 1; tick <= 600 && stopped == 0; ++tick) {
        grenade.advance(arena.world(), tick / 60.0);
        if (grenade.motion() == Motion::resting) stopped = tick / 60.0;
    }
    // Rolling, 5/7 of sqrt(5) m/s, against 0.1 g with 5/7 of 0.04 g along x.
    EXPECT_GT(stopped, 1.6 / 9.81 / 0.1);
    EXPECT_LT(stopped, 1.6 / 9.81 / 0.06);
}

// Slowly across a slope that friction just about holds: it turns downhill and stops, without
// swaying on for ever.
TEST(GrenadeRoll, DoesNotSwayDownASlope) {
    Arena arena;
    arena.add_quad({-50, 6, -50}, {-50, 6, 50}, {50, -6, 50}, {50, -6, -50});
    arena.commit();
    const Vec3 normal = glm::normalize(Vec3(0.12, 1, 0));
    for (const Vec3& velocity : {Vec3(0.0015, 0, 0.005), Vec3(0.005, 0, 0.005), Vec3(0, 0, 0.1)}) {
        Grenade grenade(arena.world(), {}, 0, 0.075 * normal, velocity);
        grenade.advance(arena.world(), 5);
        EXPECT_EQ(grenade.motion(), Motion::resting);
        EXPECT_LT(glm::distance(grenade.position(), 0.075 * normal), glm::length(velocity));
    }
}

//   o->
//   ______
//         |       off a table: over its edge without a jump, then down
//         |____
TEST(GrenadeRoll, FallsOffATable) {
    Arena arena;
    arena.add_floor(20);
    arena.add_box({-2, 0, -2}, {0, 1, 2});
    arena.commit();
    for (const double speed : {0.05, 0.3, 2.0, 8.0}) {
        GrenadeRules rules;
        rules.rolling_friction = 0;
        Grenade grenade(arena.world(), rules, 0, {-0.1, 1.075, 0}, {speed * 7 / 5, 0, 0});
        double highest = 0, landed = 0;
        Vec3 before = grenade.position();
        for (int tick = 1; tick <= 240 * 5; ++tick) {
            grenade.advance(arena.world(), tick / 240.0);
            highest = std::max(highest, grenade.position().y);
            ASSERT_GE(gap(arena.world(), grenade), -2e-7);
            ASSERT_GE(grenade.position().x, before.x - 1e-9) << "back onto the table";
            before = grenade.position();
            if (landed == 0 && !grenade.bounces().empty()) landed = grenade.position().x;
        }
        EXPECT_LT(highest, 1.075 + 2e-6);
        EXPECT_LT(grenade.position().y, 0.5);
        if (speed == 8) { // as from a launcher at the edge
            EXPECT_NEAR(landed, 8 * std::sqrt(2 * 1 / 9.81), 0.1);
        }
    }
}

TEST(GrenadeRoll, RidesALiftAndFallsWhenItIsGone) {
    Arena arena;
    arena.add_floor(20);
    const rt_mesh lift = arena.add_mover({-1, 0.5, -1}, {1, 1, 1});
    arena.commit();
    Grenade grenade(arena.world(), {}, 0, {0, 1.2, 0}, Vec3(0));
    int tick = 0;
    const auto run_for = [&](int ticks, double lift_step) {
        for (int i = 0; i < ticks; ++i) {
            if (lift_step != 0) arena.shift(lift, {0, lift_step, 0});
            grenade.advance(arena.world(), ++tick / 60.0);
        }
    };
    run_for(120, 0);
    ASSERT_EQ(grenade.motion(), Motion::resting);
    run_for(60, 0.01);
    EXPECT_NEAR(grenade.position().y, 1.675, 0.01);
    run_for(60, 0);
    ASSERT_EQ(grenade.motion(), Motion::resting);
    EXPECT_NEAR(grenade.position().y, 1.675, 1e-4);
    run_for(60, -0.01);
    run_for(60, 0);
    EXPECT_NEAR(grenade.position().y, 1.075, 1e-4);
    arena.shift(lift, {5, 0, 0});
    run_for(120, 0);
    EXPECT_NEAR(grenade.position().y, 0.075, 1e-4);
    EXPECT_EQ(grenade.motion(), Motion::resting);
}

} // namespace
} // namespace peregrine::test
