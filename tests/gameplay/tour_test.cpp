// The character walks through levels made by others, along ways that were found without it.
// PEREGRINE_TOUR=full walks through all of them; otherwise through a part of each.
#include "gltf/import.h"
#include "support/arena.h"
#include "support/floor_graph.h"
#include "support/wanderer.h"
#include "support/world.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace peregrine::test {
namespace {

using gameplay::Character;

constexpr double kStep = 1.0 / 60;
constexpr gameplay::CharacterRules kRules{.step_height = 0.46}; // these levels' own: 18 units
constexpr int kPatience = 3 * 60; // steps from one point to the next, half a metre away

struct Extent {
    size_t points; // of the graph
    size_t goals;  // of a connected part of the level
};

struct Log {
    size_t graph = 0, parts = 0, waypoints = 0, reached = 0, steps = 0;
    size_t fallen = 0, overlapping = 0;
    double metres = 0;
};

bool is_full() {
    const char* extent = std::getenv("PEREGRINE_TOUR");
    return extent && std::string(extent) == "full";
}

class Tour {
public:
    Tour(const std::string& path, const Extent& extent) : extent_(extent) {
        const host::Level level = host::gltf::import_file(path);
        for (const host::Mesh& mesh : level.meshes)
            for (size_t i = 0; i < mesh.indices.size(); i += 3)
                arena_.add_triangle(mesh.positions[mesh.indices[i]],
                                    mesh.positions[mesh.indices[i + 1]],
                                    mesh.positions[mesh.indices[i + 2]]);
        arena_.commit();
        lowest_ = level.bounds.lower.y;
        for (const host::Viewpoint& spawn : level.spawns) spawns_.push_back(spawn.position);
    }

    Log walk() {
        FloorGraph graph(arena_.world(), kRules);
        for (const Vec3& spawn : spawns_) {
            const size_t before = graph.size();
            const auto start = graph.explore(spawn, extent_.points);
            if (!start || graph.size() < before + 50)
                continue; // a part that was walked, or a niche
            ++log_.parts;
            walk_part(graph, *start);
            if (!is_full()) break;
        }
        log_.graph = graph.size();
        return log_;
    }

    // At random, with jumps, from spawn to spawn; who falls out of the level begins at the next.
    void wander(int steps_each) {
        size_t walks = 0;
        for (size_t i = 0; i < spawns_.size(); ++i) {
            const auto floor = arena_.world().closest(spawns_[i], {0, -4, 0});
            if (!floor) continue;
            Character character(arena_.world(), kRules);
            character.place(floor->point);
            if (arena_.world().overlaps(character.capsule())) continue; // a niche for smaller ones
            ++walks;
            Wanderer wanderer{uint32_t(i)};
            for (int k = 0; k < steps_each && character.state().position.y > lowest_ - 1; ++k) {
                character.update(wanderer.next(), kStep);
                ASSERT_FALSE(arena_.world().overlaps(character.capsule()))
                    << "spawn " << i << ", step " << k;
                ASSERT_LT(glm::length(character.state().velocity), 60) << i;
            }
        }
        EXPECT_GT(2 * walks, spawns_.size());
    }

private:
    // From goal to goal, chosen at random.
    void walk_part(const FloorGraph& graph, uint32_t start) {
        const std::vector<uint32_t> all = graph.reached_from(start);
        std::mt19937 random(1);
        Character character =
            standing(arena_.world(), graph.position(start) + Vec3(0, 0.05, 0), kRules);
        uint32_t at = start;
        for (size_t goal = 0; goal < extent_.goals; ++goal) {
            const uint32_t to = all[random() % all.size()];
            const std::vector<uint32_t> way = graph.path(at, to);
            for (size_t i = 1; i < way.size(); ++i) go(character, graph.position(way[i]));
            if (!way.empty()) at = to;
        }
    }

    void go(Character& character, const Vec3& point) {
        ++log_.waypoints;
        for (int i = 0; i < kPatience; ++i) {
            const Vec3 before = character.state().position;
            const Vec3 left(point.x - before.x, 0, point.z - before.z);
            const double length = glm::length(left);
            if (length < 0.2 && std::abs(point.y - before.y) < 0.5) {
                ++log_.reached;
                return;
            }
            // No faster than arrives: what is a step of the way away.
            const double pace = std::min(1.0, length / (character.rules().speed * kStep));
            run(character, {.walk = left * (pace / length)}, 1);
            ++log_.steps;
            log_.metres += glm::length(character.state().position - before);
            log_.fallen += character.state().position.y < lowest_;
            log_.overlapping += arena_.world().overlaps(character.capsule());
        }
        const Vec3 p = character.state().position;
        std::printf("stuck at (%.3f %.3f %.3f) before (%.3f %.3f %.3f)%s\n", p.x, p.y, p.z, point.x,
                    point.y, point.z, character.state().grounded ? "" : ", in the air");
        character = standing(arena_.world(), point + Vec3(0, 0.05, 0), kRules);
    }

    Arena arena_;
    Extent extent_;
    double lowest_ = 0;
    std::vector<Vec3> spawns_;
    Log log_;
};

void tour(const std::string& name) {
    const std::vector<std::string> names = scene_names();
    if (std::find(names.begin(), names.end(), name) == names.end())
        GTEST_SKIP() << "no scene " << name << ": see PEREGRINE_SCENES";
    const Extent extent = is_full() ? Extent{200000, 40} : Extent{1000, 8};
    Tour tour(scenes_folder() + "/" + name + ".glb", extent);
    const Log log = tour.walk();
    std::printf("%s: %zu points of the floor in %zu parts; %zu of %zu waypoints reached, %.0f m, "
                "%zu steps\n",
                name.c_str(), log.graph, log.parts, log.reached, log.waypoints, log.metres,
                log.steps);
    EXPECT_GT(log.waypoints, 50u);
    EXPECT_EQ(log.reached, log.waypoints);
    EXPECT_EQ(log.fallen, 0u);
    EXPECT_EQ(log.overlapping, 0u);
    tour.wander(is_full() ? 10000 : 200);
}

TEST(Tour, OaDm2) {
    tour("oa_dm2");
}
TEST(Tour, CtfCompromise) {
    tour("ctf_compromise");
}
TEST(Tour, Kaos) {
    tour("kaos");
}
TEST(Tour, Oacmpdm10) {
    tour("oacmpdm10");
}

} // namespace
} // namespace peregrine::test
