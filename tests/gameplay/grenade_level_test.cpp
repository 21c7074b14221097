// Grenades thrown into levels made by others: wherever they come from, they come to rest inside.
// PEREGRINE_GRENADES=1000 throws that many into each; otherwise a few.
#include "gltf/import.h"
#include "support/throws.h"
#include "support/world.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace peregrine::test {
namespace {

using gameplay::Grenade;
using gameplay::GrenadeRules;
using gameplay::Motion;
using gameplay::Random;

constexpr double kPatience = 60; // s

size_t throws_per_level() {
    const char* text = std::getenv("PEREGRINE_GRENADES");
    return text ? std::strtoull(text, nullptr, 10) : 25;
}

struct Fate {
    Motion motion;
    double seconds;  // until it rested
    bool left_level; // through a hole, as the sky: levels are not closed
    bool passed;     // got to where there is no way from where it came from
    double deepest;  // gap, negative inside
    size_t bounces;
};

class LevelTest {
public:
    explicit LevelTest(const std::string& path) {
        const host::Level level = host::gltf::import_file(path);
        for (const host::Mesh& mesh : level.meshes)
            for (size_t i = 0; i < mesh.indices.size(); i += 3)
                arena_.add_triangle(mesh.positions[mesh.indices[i]],
                                    mesh.positions[mesh.indices[i + 1]],
                                    mesh.positions[mesh.indices[i + 2]]);
        arena_.commit();
        bounds_ = level.bounds;
        for (const host::Viewpoint& camera : level.cameras) eyes_.push_back(camera.position);
        for (const host::Viewpoint& spawn : level.spawns) eyes_.push_back(spawn.position);
    }

    Fate run(Random& random) {
        const Vec3& eye = eyes_[random.below(uint32_t(eyes_.size()))];
        const Vec3 velocity = 20.0 * random.in_ball();
        GrenadeRules rules;
        rules.restitution = random.between(0, 0.8);
        const auto world = arena_.world();
        Grenade grenade(world, rules, 0, eye, velocity);
        Fate fate{Motion::flying, kPatience, false, false, 0, 0};
        for (int tick = 1; tick <= 60 * kPatience; ++tick) {
            const Vec3 before = grenade.position();
            grenade.advance(world, tick / 60.0);
            fate.bounces += grenade.bounces().size();
            fate.motion = grenade.motion();
            fate.deepest = std::min(fate.deepest, gap(world, grenade));
            fate.passed |= !came_freely(grenade, before);
            fate.seconds = tick / 60.0;
            fate.left_level = grenade.position().y < bounds_.lower.y - 1;
            if (fate.motion == Motion::resting || fate.left_level) break;
        }
        return fate;
    }

private:
    // From bounce to bounce nothing lies in the way of the centre.
    bool came_freely(const Grenade& grenade, Vec3 from) const {
        for (const gameplay::Bounce& bounce : grenade.bounces()) {
            const Vec3 to = bounce.contact.point + grenade.rules().radius * bounce.contact.normal;
            if (!arena_.world().is_free(from, to)) return false;
            from = to;
        }
        return arena_.world().is_free(from, grenade.position());
    }

    Arena arena_;
    host::Bounds bounds_;
    std::vector<Vec3> eyes_;
};

void throw_into(const std::string& name) {
    const std::vector<std::string> names = scene_names();
    if (std::find(names.begin(), names.end(), name) == names.end())
        GTEST_SKIP() << "no scene " << name << ": see PEREGRINE_SCENES";
    LevelTest level(scenes_folder() + "/" + name + ".glb");
    Random random(1);
    size_t rested = 0, left = 0, passed = 0, bounces = 0;
    double deepest = 0;
    std::vector<double> seconds;
    for (size_t i = 0; i < throws_per_level(); ++i) {
        const Fate fate = level.run(random);
        rested += fate.motion == Motion::resting;
        left += fate.left_level;
        passed += fate.passed;
        bounces += fate.bounces;
        deepest = std::min(deepest, fate.deepest);
        if (!fate.left_level) seconds.push_back(fate.seconds);
    }
    std::sort(seconds.begin(), seconds.end());
    ASSERT_FALSE(seconds.empty());
    std::printf(
        "%s: %zu throws, %zu rested (median %.1f s, longest %.1f s), %zu left through a hole, "
        "%zu bounces, deepest %.1e m\n",
        name.c_str(), throws_per_level(), rested, seconds[seconds.size() / 2], seconds.back(), left,
        bounces, -deepest);
    EXPECT_EQ(rested + left, throws_per_level());
    EXPECT_EQ(passed, 0u);
    EXPECT_GE(deepest, -1e-5);
}

TEST(GrenadeLevel, OaDm2) {
    throw_into("oa_dm2");
}
TEST(GrenadeLevel, CtfCompromise) {
    throw_into("ctf_compromise");
}
TEST(GrenadeLevel, Kaos) {
    throw_into("kaos");
}
TEST(GrenadeLevel, Oacmpdm10) {
    throw_into("oacmpdm10");
}

} // namespace
} // namespace peregrine::test
