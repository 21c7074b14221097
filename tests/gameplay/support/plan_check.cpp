#include "support/plan_check.h"

#include "gameplay/three_cores/rules.h"
#include "gameplay/three_cores/way.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace peregrine::test {
namespace {

using gameplay::Character;
using gameplay::Vec3;
using gameplay::World;
using three_cores::Floors;
using three_cores::Plan;

constexpr double kStep = 1.0 / 60;
constexpr int kPatience = 180;  // steps from one point to the next, half a metre away
constexpr double kReach = 1.3;  // metres: cores
constexpr double kDrone = 0.44; // metres: radius of what must fit
constexpr double kPeace = 10;   // metres around the spawn
constexpr double kJoined = 9;   // metres: ends nearer than this are joined

Vec3 chest(const Character& character) {
    return character.state().position + Vec3(0, 1, 0);
}

bool go(Character& character, const Vec3& point) {
    for (int i = 0; i < kPatience; ++i) {
        const Vec3 place = character.state().position;
        const Vec3 left(point.x - place.x, 0, point.z - place.z);
        const double length = glm::length(left);
        if (length < 0.2 && std::abs(point.y - place.y) < 0.5) return true;
        const double pace = std::min(1.0, length / (character.rules().speed * kStep));
        character.update({.walk = left * (pace / length)}, kStep);
    }
    return false;
}

} // namespace

gameplay::CharacterRules plan_walker() {
    return three_cores::rules_of(three_cores::Difficulty::normal).character;
}

uint64_t hash(const Plan& plan) {
    gameplay::StateHash hash;
    for (const three_cores::Spawn& spawn : plan.spawns) {
        hash.add(spawn.feet);
        hash.add(spawn.forward);
    }
    hash.add(uint64_t(plan.cores.size()));
    for (const Vec3& core : plan.cores) hash.add(core);
    for (const auto& round : plan.patrols) {
        hash.add(uint64_t(round.size()));
        for (const Vec3& point : round) hash.add(point);
    }
    for (const Vec3& exit : plan.exits) hash.add(exit);
    return hash.value();
}

Walk walk_plan(const World& world, const Plan& plan) {
    Floors floors(world, plan_walker());
    floors.explore(plan.spawns.at(0).feet, 100000);
    Character character(world, plan_walker());
    character.place(plan.spawns[0].feet + Vec3(0, 0.01, 0));
    EXPECT_FALSE(world.overlaps(character.capsule()));
    for (int i = 0; i < 30; ++i) character.update({}, kStep);

    std::vector<Vec3> goals = plan.cores;
    goals.insert(goals.end(), plan.exits.begin(), plan.exits.end());
    Walk walk;
    for (const Vec3& goal : goals) {
        ++walk.goals;
        bool arrives = true;
        for (const Vec3& point : three_cores::find_way(floors, character.state().position, goal)) {
            const Vec3 before = character.state().position;
            if (arrives && !go(character, point)) {
                const Vec3 p = character.state().position;
                ADD_FAILURE() << "stuck at " << p.x << " " << p.y << " " << p.z << " before "
                              << point.x << " " << point.y << " " << point.z;
                arrives = false;
            }
            walk.metres += glm::distance(before, character.state().position);
        }
        walk.reached += glm::distance(chest(character), goal) < kReach;
    }
    return walk;
}

void expect_free_rounds(const World& world, const Plan& plan) {
    const Vec3 eye = plan.spawns.at(0).feet + Vec3(0, 1.6, 0);
    for (const std::vector<Vec3>& round : plan.patrols) {
        ASSERT_GE(round.size(), 2u);
        ASSERT_LE(round.size(), 5u);
        std::vector<Vec3> legs = round;
        if (round.size() > 2 && glm::distance(round.front(), round.back()) < kJoined)
            legs.push_back(round.front());
        for (size_t i = 1; i < legs.size(); ++i) {
            const Vec3 leg = legs[i] - legs[i - 1];
            EXPECT_GT(glm::length(leg), 1.0);
            EXPECT_TRUE(world.is_free(legs[i - 1], legs[i]));
            EXPECT_FALSE(world.sweep({legs[i - 1], kDrone}, leg, {}, false)) << i;
            for (int k = 0; k <= 20; ++k) {
                const Vec3 point = legs[i - 1] + leg * (k / 20.0);
                EXPECT_TRUE(glm::distance(point, eye) > kPeace || !world.is_free(eye, point))
                    << "a drone sees the spawn";
            }
            const auto floor = world.closest(legs[i - 1], {0, -2, 0});
            ASSERT_TRUE(floor);
            EXPECT_NEAR(legs[i - 1].y - floor->point.y, 1.8, 1e-4);
        }
    }
}

double length_of_rounds(const Plan& plan) {
    double sum = 0;
    for (const std::vector<Vec3>& round : plan.patrols)
        for (size_t i = 1; i < round.size(); ++i) sum += glm::distance(round[i - 1], round[i]);
    return sum;
}

} // namespace peregrine::test
