// Places where spheres jam, tremble or slip through.
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

// Runs until it rests, and expects it to stay there.
void expect_rest(const gameplay::World& world, Grenade& grenade, double seconds) {
    const double start = grenade.time();
    for (int tick = 1; tick <= 60 * seconds; ++tick) {
        grenade.advance(world, start + tick / 60.0);
        ASSERT_GE(gap(world, grenade), -2e-7) << tick;
    }
    ASSERT_EQ(grenade.motion(), Motion::resting);
    const Vec3 rest = grenade.position();
    for (int i = 1; i <= 60; ++i) grenade.advance(world, start + seconds + i / 60.0);
    EXPECT_EQ(grenade.position(), rest);
    EXPECT_EQ(grenade.velocity(), Vec3(0));
}

//    |            |
//    |_  o ->     |_     all eight corners of a room, with gravity into each
TEST(GrenadeCorner, RestsInEveryCorner) {
    Arena arena;
    arena.add_room({-1, -1, -1}, {1, 1, 1});
    arena.commit();
    for (int corner = 0; corner < 8; ++corner)
        for (const double restitution : {0.0, 0.5}) {
            const Vec3 way(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
            GrenadeRules rules;
            rules.gravity = 5.0 * way;
            rules.restitution = restitution;
            Grenade grenade(arena.world(), rules, 0, Vec3(0.1, 0.2, 0), 8.0 * way);
            expect_rest(arena.world(), grenade, 8);
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(grenade.position()[axis], 0.925 * way[axis], 1e-5);
        }
}

//     \   /
//      \o/       a V of a few degrees up to a right angle, level or sloping along
//       V
TEST(GrenadeCorner, RestsInAWedge) {
    for (const double half_width : {0.1, 0.3, 1.0})
        for (const double slope : {0.0, 0.02}) {
            Arena arena;
            for (const double side : {-1.0, 1.0})
                arena.add_quad({-9, -9 * slope, 0}, {9, 9 * slope, 0},
                               {9, 9 * slope + 1, side * half_width},
                               {-9, -9 * slope + 1, side * half_width});
            arena.commit();
            for (const double restitution : {0.0, 0.6}) {
                GrenadeRules rules;
                rules.restitution = restitution;
                rules.radius = 0.05;
                Grenade grenade(arena.world(), rules, 0, {0, 1.2, 0.01}, {0.3, -2, 0.1});
                expect_rest(arena.world(), grenade, 12);
                EXPECT_NEAR(grenade.position().z, 0, 2e-3);
            }
        }
}

// Restitution 1 and no friction between two walls that meet: it comes out again with its energy.
TEST(GrenadeCorner, ComesOutOfAWedgeAtRestitutionOne) {
    Arena arena;
    for (const double side : {-1.0, 1.0})
        arena.add_quad({-9, 0, 0}, {9, 0, 0}, {9, 4, side * 0.4}, {-9, 4, side * 0.4});
    arena.commit();
    GrenadeRules rules;
    rules.restitution = 1;
    rules.friction = 0;
    rules.gravity = Vec3(0);
    Grenade grenade(arena.world(), rules, 0, {0, 3, 0.01}, {0.1, -5, 0.02});
    const double before = energy(grenade);
    grenade.advance(arena.world(), 2);
    EXPECT_GT(grenade.velocity().y, 4);
    EXPECT_NEAR(energy(grenade), before, 1e-6);
    EXPECT_GE(gap(arena.world(), grenade), -2e-7);
}

// A funnel of many facets: more surfaces than hold a ball.
TEST(GrenadeCorner, RestsInAFunnelOfManyFacets) {
    constexpr int kFacets = 24;
    Arena arena;
    const auto rim = [](int i) {
        const double angle = 2 * M_PI * i / kFacets;
        return Vec3(std::cos(angle), 0.7, std::sin(angle));
    };
    for (int i = 0; i < kFacets; ++i) arena.add_triangle({0, 0, 0}, rim(i + 1), rim(i));
    arena.commit();
    Random random(3);
    for (int i = 0; i < 10; ++i) {
        GrenadeRules rules;
        rules.restitution = 0.1 * i;
        const Vec3 velocity = 0.8 * random.in_ball();
        Grenade grenade(arena.world(), rules, 0, {0.2, 0.6, 0.1}, velocity);
        expect_rest(arena.world(), grenade, 20);
        EXPECT_NEAR(grenade.position().x, 0, 5e-3);
        EXPECT_NEAR(grenade.position().z, 0, 5e-3);
    }
}

// Straight onto a vertex and along an edge.
TEST(GrenadeCorner, BalancesOnNothing) {
    Arena arena;
    arena.add_floor(20);
    arena.add_triangle({-1, 0, -1}, {1, 0, -1}, {0, 1, 0}); // a pyramid
    arena.add_triangle({1, 0, -1}, {1, 0, 1}, {0, 1, 0});
    arena.add_triangle({1, 0, 1}, {-1, 0, 1}, {0, 1, 0});
    arena.add_triangle({-1, 0, 1}, {-1, 0, -1}, {0, 1, 0});
    arena.commit();
    for (const Vec3& offset : {Vec3(1e-9, 0, 0), Vec3(1e-3, 0, 1e-3), Vec3(0.02, 0, 0)}) {
        Grenade grenade(arena.world(), {}, 0, Vec3(0, 2, 0) + offset, Vec3(0));
        expect_rest(arena.world(), grenade, 20);
        EXPECT_NEAR(grenade.position().y, 0.075, 1e-4);
    }
}

//   | o |     What starts inside a wall gets out on the side of its centre; what is caught between
//   |(_)|     walls too narrow for it stays, and goes on when there is room.
TEST(GrenadeCorner, IsPushedOutOfAWall) {
    Arena arena;
    arena.add_floor(20);
    arena.add_box({1, 0, -2}, {2, 2, 2});
    arena.commit();
    for (const double x : {0.99, 0.95, 2.001, 2.05}) {
        Grenade grenade(arena.world(), {}, 0, {x, 1, 0}, Vec3(0));
        EXPECT_GE(gap(arena.world(), grenade), 0);
        expect_rest(arena.world(), grenade, 20);
        EXPECT_EQ(grenade.position().x > 1.5, x > 1.5);
        EXPECT_TRUE(grenade.position().x < 1 || grenade.position().x > 2);
    }
}

TEST(GrenadeCorner, StaysInACrackUntilThereIsRoom) {
    Arena arena;
    arena.add_floor(20);
    arena.add_box({-1, 0, -2}, {-0.05, 2, 2});
    const rt_mesh door = arena.add_mover({0.05, 0, -2}, {1, 2, 2});
    arena.commit();
    Grenade grenade(arena.world(), {}, 0, {0, 1, 0}, {0, 0, 1});
    for (int i = 1; i <= 60; ++i) grenade.advance(arena.world(), i / 60.0);
    EXPECT_EQ(grenade.motion(), Motion::resting);
    EXPECT_LT(glm::distance(grenade.position(), Vec3(0, 1, 0)), 0.1);
    arena.shift(door, {1, 0, 0});
    for (int i = 61; i <= 400; ++i) grenade.advance(arena.world(), i / 60.0);
    EXPECT_EQ(grenade.motion(), Motion::resting);
    EXPECT_NEAR(grenade.position().y, 0.075, 1e-4);
    EXPECT_GE(gap(arena.world(), grenade), -2e-7);
}

} // namespace
} // namespace peregrine::test
