#include <cmath>

#include <gtest/gtest.h>

#include "effects/level_effects.h"
#include "game/sparks.h"
#include "plugin.h"
#include "upload.h"

namespace host {

namespace {

using three_cores::Event;
using three_cores::Sound;

Viewpoint place(const char* name, const glm::dvec3& position) {
    Viewpoint place;
    place.name = name;
    place.position = position;
    return place;
}

Light lamp(const char* name, const glm::dvec3& position) {
    Light light;
    light.name = name;
    light.position = position;
    return light;
}

// What the engine takes; its own test says what it refuses.
void expect_good(const std::vector<rt_particle>& particles) {
    for (const rt_particle& particle : particles) {
        EXPECT_GT(particle.radius, 0.0f);
        for (int k = 0; k < 3; ++k) {
            EXPECT_TRUE(std::isfinite(particle.position[k]));
            EXPECT_GE(particle.color[k], 0.0f);
            EXPECT_TRUE(std::isfinite(particle.color[k]));
        }
    }
}

class EffectsTest : public testing::Test {
protected:
    EffectsTest() {
        level.lights = {lamp("brazier_0", {0, 1, 0}), lamp("moon_0", {0, 9, 0}),
                        lamp("sconce_3", {4, 2, 0})};
        level.places = {place("spray_0", {20, 3, 0}), place("mist_0", {20, 1.5, 0}),
                        place("spraying", {0, 0, 0})};
        for (const Light& light : level.lights) {
            const rt_light_desc desc = describe_light(light);
            rt_light& handle = lights.emplace_back();
            stage.check(stage.api().add_light(stage.scene(), &desc, &handle), "a light");
        }
    }

    uint32_t left_out() {
        return stage.commit(RT_STRUCTURE_AUTO, RT_BUILD_BALANCED, nullptr).left_out;
    }

    Plugin plugin{ENGINE};
    Stage stage{plugin.api(), 1, RT_ISA_BEST};
    Level level;
    std::vector<rt_light> lights;
};

} // namespace

TEST_F(EffectsTest, FiresBurnWhereLampsAreNamedSo) {
    const Fires fires(level);
    ASSERT_EQ(fires.all().size(), 2u);
    EXPECT_EQ(fires.all()[0].lamp, 0u);
    EXPECT_EQ(fires.all()[1].lamp, 2u);
    for (const double seconds : {0.0, 0.77, 12345.6}) {
        std::vector<rt_particle> particles, again;
        fires.add(seconds, particles);
        fires.add(seconds, again);
        expect_good(particles);
        ASSERT_EQ(particles.size(), again.size());
        for (size_t i = 0; i < particles.size(); ++i) {
            const rt_particle &a = particles[i], &b = again[i];
            EXPECT_EQ(a.position[1], b.position[1]);
            const double x = std::min(std::abs(a.position[0]), std::abs(a.position[0] - 4));
            EXPECT_LT(std::hypot(x, a.position[2]), 1.0);
        }
        for (const Fires::Fire& fire : fires.all()) EXPECT_NEAR(flicker(fire, seconds), 1, 0.15);
    }
    EXPECT_NE(flicker(fires.all()[0], 1.0), flicker(fires.all()[1], 1.0));
}

TEST_F(EffectsTest, SprayFallsIntoTheBasin) {
    LevelEffects effects(stage, level, lights);
    for (const double seconds : {0.0, 1.1, 3600.5}) {
        std::vector<rt_particle> particles;
        effects.add_particles(seconds, particles);
        expect_good(particles);
        int drops = 0;
        for (const rt_particle& particle : particles) {
            if (particle.position[0] < 10) continue; // fires
            ++drops;
            EXPECT_LT(std::hypot(particle.position[0] - 20, particle.position[2]), 1.7);
            EXPECT_GT(particle.position[1], 0.3);
            EXPECT_LT(particle.position[1], 3.4);
        }
        EXPECT_EQ(drops, 700);
    }
}

TEST_F(EffectsTest, MistIsThereForWhoIsNear) {
    level.lights.clear(); // so that nothing flickers
    LevelEffects effects(stage, level, lights);
    EXPECT_FALSE(effects.describe(0, {0, 1.7, 0}));
    EXPECT_TRUE(left_out() & RT_FEATURE_FOG);
    EXPECT_TRUE(effects.describe(0, {14, 1.7, 0}));
    EXPECT_FALSE(left_out() & RT_FEATURE_FOG);
    EXPECT_FALSE(effects.describe(0, {14, 1.7, 0}));
    EXPECT_TRUE(effects.describe(0, {-14, 1.7, 0}));
    EXPECT_TRUE(left_out() & RT_FEATURE_FOG);
    EXPECT_TRUE(effects.describe(0, {20, 1.7, 0}));
    effects.hide_mist();
    EXPECT_TRUE(left_out() & RT_FEATURE_FOG);
    LevelEffects without(stage, level, lights, /*has_mist=*/false);
    EXPECT_FALSE(without.describe(0, {20, 1.7, 0}));
}

TEST_F(EffectsTest, SparksFlyAndAreGone) {
    game::Sparks sparks;
    const Event events[] = {{Sound::blast, {1, 2, 3}}, {Sound::step, {0, 0, 0}}};
    sparks.add(events, 5.0);
    const auto count = [&](double seconds) {
        std::vector<rt_particle> particles;
        sparks.add_particles(seconds, particles);
        expect_good(particles);
        return particles.size();
    };
    EXPECT_EQ(count(5.0), 221u); // with the flash
    EXPECT_LT(count(5.6), 221u);
    EXPECT_GT(count(5.6), 50u);
    EXPECT_EQ(count(7.0), 0u);
    EXPECT_EQ(count(5.0), 0u); // forgotten
}

} // namespace host
