#include "gameplay/sentry.h"
#include "support/arena.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

namespace peregrine::test {
namespace {

using gameplay::Mood;
using gameplay::Notice;
using gameplay::Sentry;
using gameplay::SentryRules;
using gameplay::Target;
using gameplay::Watch;

constexpr double kStep = 1.0 / 60;

struct Scene {
    Scene() { arena.add_floor(60, -0.01); }

    const Notice& look(const Vec3& target, int steps = 1) {
        const Target body{target};
        for (int i = 0; i < steps; ++i)
            watch.update(arena.world(), {&sentry, 1}, {&body, 1}, kStep);
        return watch.notice(0, 0);
    }

    Arena arena;
    Watch watch;
    Sentry sentry{{0, 1.7, 0}, {1, 0, 0}};
};

TEST(Sentry, SeesWhatIsInItsConeAndRange) {
    Scene scene;
    scene.arena.commit();
    EXPECT_EQ(scene.look({10, 0, 0}).visibility, 1);
    EXPECT_EQ(scene.look({29, 0, 0}).visibility, 1);
    EXPECT_EQ(scene.look({31, 0, 0}).visibility, 0);
    EXPECT_EQ(scene.look({-10, 0, 0}).visibility, 0);
    EXPECT_EQ(scene.look({5, 0, 8}).visibility, 1);  // 58 degrees
    EXPECT_EQ(scene.look({5, 0, 10}).visibility, 0); // 63 degrees
    EXPECT_EQ(scene.watch.rays(), 0u);
}

//      o            behind a wall up to the waist: head, chest and shoulders, not the feet
//      |  __   o
//     _|_|__|_/|_
TEST(Sentry, SeesAPart) {
    Scene scene;
    scene.arena.add_box({7, -1, -5}, {8, 1, 5});
    scene.arena.commit();
    EXPECT_DOUBLE_EQ(scene.look({9, 0, 0}).visibility, 0.8);
    EXPECT_EQ(scene.watch.rays(), 5u);
    EXPECT_EQ(scene.look({4, 0, 0}).visibility, 1);
}

TEST(Sentry, SeesAShoulderBesideADoorPost) {
    Scene scene;
    scene.arena.add_box({4.9, -1, -5}, {5, 3, 0});
    scene.arena.commit();
    EXPECT_DOUBLE_EQ(scene.look({10, 0, -0.05}).visibility, 0.2);
    EXPECT_DOUBLE_EQ(scene.look({10, 0, -0.5}).visibility, 0);
}

TEST(Sentry, GrowsCertainAndForgets) {
    Scene scene;
    scene.arena.add_box({5, -1, 20}, {6, 3, 30});
    scene.arena.commit();
    const Notice& notice = scene.look({2, 0, 0}, 10);
    EXPECT_EQ(notice.mood, Mood::suspicious);
    const double soon = notice.suspicion;
    scene.look({2, 0, 0}, 30);
    EXPECT_EQ(notice.mood, Mood::alarmed);
    EXPECT_EQ(notice.suspicion, 1);
    EXPECT_EQ(notice.last_known, Vec3(2, 0, 0));

    // Farther away it takes longer.
    scene.watch.reset(1, 1);
    scene.look({25, 0, 0}, 10);
    EXPECT_LT(scene.watch.notice(0, 0).suspicion, 0.6 * soon);

    // Gone behind: alarmed until it has forgotten, and it knows where and how long ago.
    scene.watch.reset(1, 1);
    scene.look({2, 0, 0}, 60);
    scene.look({-3, 0, 0}, 4 * 60);
    const Notice& lost = scene.watch.notice(0, 0);
    EXPECT_EQ(lost.mood, Mood::alarmed);
    EXPECT_EQ(lost.last_known, Vec3(2, 0, 0));
    EXPECT_NEAR(lost.unseen, 4, 1e-9);
    EXPECT_NEAR(lost.suspicion, 0.5, 1e-9);
    scene.look({-3, 0, 0}, 5 * 60);
    EXPECT_EQ(lost.mood, Mood::calm);
}

TEST(Sentry, HearsAndIsSuspiciousNeverCertain) {
    Scene scene;
    scene.arena.add_box({-7, -1, -9}, {-6, 3, 9}); // a wall behind it
    scene.arena.commit();
    scene.watch.reset(1, 1);
    const auto hear = [&](const Vec3& point, double radius) {
        scene.watch.reset(1, 1);
        scene.watch.hear(scene.arena.world(), {&scene.sentry, 1}, {point, radius, 0});
        return scene.watch.notice(0, 0);
    };
    EXPECT_EQ(hear({-5, 0, 0}, 10).mood, Mood::suspicious);
    EXPECT_EQ(hear({-5, 0, 0}, 10).last_known, Vec3(-5, 0, 0));
    EXPECT_EQ(hear({-5, 0, 0}, 4).mood, Mood::calm);        // too far
    EXPECT_EQ(hear({-9, 0, 0}, 10).mood, Mood::calm);       // behind the wall
    EXPECT_EQ(hear({-9, 0, 0}, 20).mood, Mood::suspicious); // but loud
}

// Sentries and targets on a ring of walls: the batch says what single rays say.
TEST(Sentry, WatchesThousandsOfPairsInOneBatch) {
    Arena arena;
    arena.add_floor(60, -0.01);
    for (int i = -10; i <= 10; ++i)
        for (int k = -10; k <= 10; k += 2)
            arena.add_box({4.0 * i, -1, 4.0 * k},
                          {4.0 * i + 0.3, 0.7 + 0.2 * ((i + k + 20) % 9), 4.0 * k + 3});
    arena.commit();
    std::vector<Sentry> sentries;
    std::vector<Target> targets;
    for (int i = 0; i < 64; ++i) {
        const double a = 0.6 * (i % 8), b = 5 * (i / 8);
        sentries.push_back({{-20 + 5.3 * (i % 8), 1.7, -18 + b}, {std::sqrt(1 + a), 0, 2 - a}});
        targets.push_back({{-19 + 5.1 * (i % 8), 0, -16.5 + 4.7 * (i / 8)}});
    }
    Watch watch;
    watch.update(arena.world(), sentries, targets, kStep);
    EXPECT_GT(watch.rays(), 1500u);

    size_t seen = 0, hidden = 0;
    for (size_t s = 0; s < sentries.size(); ++s)
        for (size_t t = 0; t < targets.size(); ++t) {
            Watch alone;
            alone.update(arena.world(), {&sentries[s], 1}, {&targets[t], 1}, kStep);
            gameplay::StateHash one, of_many;
            add(one, alone.notice(0, 0));
            add(of_many, watch.notice(s, t));
            ASSERT_EQ(one.value(), of_many.value()) << s << ' ' << t;
            seen += alone.notice(0, 0).visibility > 0;
            hidden += alone.notice(0, 0).visibility == 0 && alone.rays() > 0;
        }
    EXPECT_GT(seen, 100u);
    EXPECT_GT(hidden, 50u);

    // The first update made the batch's memory.
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 20; ++i) watch.update(arena.world(), sentries, targets, kStep);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    RecordProperty("pairs", int(sentries.size() * targets.size()));
    RecordProperty("rays", int(watch.rays()));
    RecordProperty("microseconds_an_update", int(time.count() / 20 * 1000));
}

} // namespace
} // namespace peregrine::test
