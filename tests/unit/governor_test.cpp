#include "render/governor.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

const uint32_t kLast = uint32_t(governor_levels().size()) - 1;

// A machine on which the best level takes so long; each other is cheaper by its own ratio.
struct Machine {
    double best_ms;
    std::vector<double> share; // of the best level's time, by level
    double noise = 0;          // relative
    std::mt19937 random{7};

    Machine(double ms, double first_ratio, double last_ratio) : best_ms(ms) {
        double part = 1;
        for (uint32_t level = 0; level <= kLast; ++level) {
            share.push_back(part);
            part /= first_ratio + (last_ratio - first_ratio) * level / kLast;
        }
    }

    double frame(uint32_t level) {
        std::normal_distribution<double> wobble(0, noise);
        return best_ms * share[level] * std::max(0.2, 1 + wobble(random));
    }
};

Governor governor(float target_ms) {
    Governor governor;
    governor.target_ms = target_ms;
    return governor;
}

struct Drive {
    uint32_t changes = 0;
    double mean_ms = 0;
};

Drive drive(Governor& governor, Machine& machine, uint32_t frames) {
    Drive sum;
    for (uint32_t i = 0; i < frames; ++i) {
        const uint32_t level = governor.level;
        const double ms = machine.frame(level);
        sum.mean_ms += ms / frames;
        governor.observe(ms);
        sum.changes += governor.level != level;
    }
    return sum;
}

TEST(Governor, FindsTheLevelThatFitsAndStays) {
    for (const double ratio : {1.02, 1.1, 1.3, 1.6, 2.5})
        for (const double ms : {1.0, 20.0, 34.0, 50.0, 90.0, 300.0, 3000.0, 1e6}) {
            Machine machine(ms, ratio, 1.5);
            Governor g = governor(33);
            drive(g, machine, 2000);
            const Drive later = drive(g, machine, 5000);
            EXPECT_EQ(later.changes, 0u) << ms << " " << ratio;
            if (ms * machine.share[kLast] < 33) {
                EXPECT_LT(later.mean_ms, 33 * 1.06) << ms;
            } else {
                EXPECT_EQ(g.level, kLast);
            }
            if (g.level > 0) {
                EXPECT_GT(ms * machine.share[g.level - 1], 33 * 0.9)
                    << "a better level would fit: " << ms << " " << ratio;
            }
        }
}

TEST(Governor, IsCalmWhenFramesAreNot) {
    for (const double noise : {0.05, 0.1, 0.2})
        for (double ms = 25; ms < 200; ms *= 1.07) {
            Machine machine(ms, 1.15, 1.5);
            machine.noise = noise;
            Governor g = governor(33);
            drive(g, machine, 1000);
            const Drive later = drive(g, machine, 3000); // 100 s
            EXPECT_LE(later.changes, noise > 0.15 ? 10u : 4u) << ms << " " << noise;
            EXPECT_LT(later.mean_ms, 33 * 1.1);
        }
}

TEST(Governor, IsFastWhereItMustBe) {
    Machine machine(300, 1.1, 1.5);
    Governor g = governor(33);
    drive(g, machine, 25);
    EXPECT_LT(machine.best_ms * machine.share[g.level], 33 * 1.05) << "within a second";
    machine.best_ms = 10;
    drive(g, machine, 90);
    EXPECT_EQ(g.level, 0u) << "and back in three";
    machine.best_ms = 80;
    drive(g, machine, 20);
    EXPECT_LT(machine.best_ms * machine.share[g.level], 33 * 1.05);
}

TEST(Governor, DoesNotMindOneLongFrame) {
    Machine machine(30, 1.1, 1.5);
    Governor g = governor(33);
    drive(g, machine, 100);
    ASSERT_EQ(g.level, 0u);
    for (int i = 0; i < 20; ++i) {
        g.observe(900);
        EXPECT_EQ(drive(g, machine, 10).changes, 0u);
        EXPECT_EQ(g.level, 0u);
    }
}

TEST(Governor, WithoutTimeIsAtTheCheapestLevel) {
    for (const float target : {0.0f, -5.0f, std::numeric_limits<float>::quiet_NaN()}) {
        Governor g = governor(target);
        g.observe(1);
        EXPECT_EQ(g.level, kLast);
    }
    Governor g = governor(std::numeric_limits<float>::infinity());
    g.level = 5;
    for (int i = 0; i < 200; ++i) g.observe(1000);
    EXPECT_EQ(g.level, 0u);
    g = governor(std::numeric_limits<float>::denorm_min());
    for (int i = 0; i < 200; ++i) g.observe(1000);
    EXPECT_EQ(g.level, kLast);
}

TEST(Governor, SurvivesWhatIsNoTime) {
    Governor g = governor(33);
    g.level = g.previous = g.patience = g.frames = ~0u;
    for (float& value : g.cost) value = std::numeric_limits<float>::quiet_NaN();
    for (const double ms : {std::numeric_limits<double>::quiet_NaN(), -1.0, 1e300, 0.0, 20.0})
        for (int i = 0; i < 50; ++i) {
            g.observe(ms);
            ASSERT_LE(g.level, kLast);
        }
}

TEST(GovernorLevels, GetCheaperInTheOrderOfLightEdgesAndSize) {
    const auto levels = governor_levels();
    for (size_t i = 1; i < levels.size(); ++i) {
        EXPECT_GE(levels[i].light_tolerance, levels[i - 1].light_tolerance);
        EXPECT_LE(levels[i].edge_samples, levels[i - 1].edge_samples);
        EXPECT_LE(levels[i].eighths, levels[i - 1].eighths);
        EXPECT_GE(levels[i].cost, 1.0f);
    }
    Approximations options;
    levels.back().apply_to(options, {1, 16384});
    EXPECT_EQ(options.render_width, 1u);
    EXPECT_EQ(options.render_height, 4096u);
    levels.front().apply_to(options, {1280, 720});
    EXPECT_EQ(options.render_width, 1280u);
    EXPECT_EQ(options.render_height, 720u);
}

} // namespace
} // namespace peregrine::render
