#include "gameplay/projectile.h"
#include "gameplay/random.h"
#include "support/arena.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace peregrine::test {
namespace {

using gameplay::Projectile;
using gameplay::ProjectileHit;
using gameplay::ProjectileRules;
using gameplay::Random;

// 1000 m/s is 17 m in a tick; the wall is 1 cm thick, the bullet 5 mm.
TEST(Projectile, NeverPassesAThinWall) {
    Arena arena;
    arena.add_box({20, -5, -5}, {20.01, 5, 5});
    arena.commit();
    Random random(4);
    for (const double rate : {30.0, 60.0, 240.0})
        for (int i = 0; i < 200; ++i) {
            ProjectileRules rules;
            if (i % 2) rules.gravity = {0, -9.81, 0};
            const Vec3 from{random.between(-20, 19), 0.5 * random.uniform(), 0};
            const Vec3 aim = Vec3(20, 0, 0) + 3.0 * Vec3(0, random.uniform(), random.uniform());
            const Vec3 velocity = 1000.0 * glm::normalize(aim - from);
            Projectile projectile(rules, 0, from, velocity);
            for (int tick = 1; tick <= rate / 10 && !projectile.is_spent(); ++tick)
                projectile.advance(arena.world(), tick / rate);
            ASSERT_TRUE(projectile.is_spent()) << i;
            ASSERT_NEAR(projectile.position().x, 20 - rules.radius, 5e-6) << i;
        }
}

TEST(Projectile, TellsWhatWhereAndWhen) {
    Arena arena;
    arena.add_quad({100, -50, -50}, {100, -50, 50}, {100, 50, 50}, {100, 50, -50});
    arena.commit();
    ProjectileRules rules;
    rules.gravity = {0, -9.81, 0};
    for (const double rate : {2.0, 60.0, 1000.0}) {
        Projectile projectile(rules, 1, Vec3(0), {400, 0, 0});
        std::vector<ProjectileHit> hits;
        for (int tick = 1; tick <= rate; ++tick)
            for (const ProjectileHit& hit : projectile.advance(arena.world(), 1 + tick / rate))
                hits.push_back(hit);
        ASSERT_EQ(hits.size(), 1u);
        const double time = (100 - rules.radius) / 400;
        EXPECT_NEAR(hits[0].time, 1 + time, 1e-8);
        EXPECT_NEAR(hits[0].point.x, 100, 4e-6); // half an ulp of a float
        EXPECT_NEAR(hits[0].point.y, -0.5 * 9.81 * time * time, 1e-6);
        EXPECT_NEAR(hits[0].normal.x, -1, 1e-6);
        EXPECT_NEAR(hits[0].velocity.y, -9.81 * time, 1e-6);
        EXPECT_LT(hits[0].triangle, 2u);
        EXPECT_FALSE(hits[0].ricochet);
        EXPECT_EQ(projectile.velocity(), Vec3(0));
    }
}

//   -__      __-
//      - _ -         flat enough: it flies on
TEST(Projectile, GlancesOffWhereItMeetsASurfaceFlat) {
    Arena arena;
    arena.add_floor(100);
    arena.commit();
    ProjectileRules rules;
    rules.ricochet_sine = 0.2;
    for (const double sine : {0.05, 0.19, 0.21, 0.9}) {
        const Vec3 velocity = 500.0 * Vec3(std::sqrt(1 - sine * sine), -sine, 0);
        Projectile projectile(rules, 0, {0, 1, 0}, velocity);
        const auto hits = projectile.advance(arena.world(), 0.1);
        ASSERT_EQ(hits.size(), 1u);
        EXPECT_EQ(hits[0].ricochet, sine < 0.2);
        EXPECT_EQ(projectile.is_spent(), sine > 0.2);
        if (sine > 0.2) continue;
        EXPECT_NEAR(projectile.velocity().x, rules.ricochet_keep * velocity.x, 1e-3);
        EXPECT_NEAR(projectile.velocity().y, -rules.ricochet_restitution * velocity.y, 1e-3);
        EXPECT_GT(projectile.position().y, 0.1);
    }
}

TEST(Projectile, FliesThroughWhatItsMaskLeavesOut) {
    Arena arena;
    const rt_mesh shooter = arena.add_mover({-1, -1, -1}, {1, 1, 1});
    arena.add_box({20, -5, -5}, {20.01, 5, 5});
    arena.commit();
    ProjectileRules rules;
    rules.mask.ignored = {&shooter, 1};
    Projectile projectile(rules, 0, Vec3(0), {1000, 0, 0});
    const auto hits = projectile.advance(arena.world(), 1);
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_NEAR(hits[0].point.x, 20, 1e-5);
}

} // namespace
} // namespace peregrine::test
