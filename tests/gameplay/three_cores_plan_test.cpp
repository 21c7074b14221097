// Plans for made-up levels, and ways over their floors.
#include "gameplay/three_cores/way.h"
#include "support/arena.h"
#include "support/plan_check.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace peregrine::test {
namespace {

using three_cores::complete_plan;
using three_cores::find_way;
using three_cores::Floors;
using three_cores::Plan;
using three_cores::PlanError;

Plan unplanned(const Vec3& lower, const Vec3& upper) {
    Plan plan;
    plan.lower = lower;
    plan.upper = upper;
    return plan;
}

// Two storeys of 20 x 20 m with a stair between them, and walls.
void add_house(Arena& arena) {
    arena.add_room({-10, 0, -10}, {10, 6.6, 10});
    arena.add_box({-10, 3, -10}, {6, 3.2, 10});
    for (int i = 0; i < 16; ++i)
        arena.add_box({6, 0, 8 - 0.4 * i - 0.4}, {10, 0.2 * (i + 1), 8 - 0.4 * i});
    arena.add_box({6, 3, -10}, {10, 3.2, 1.6});
    arena.add_box({-3, 0, -10}, {-2.8, 3, 6}); // below, a wall with a way around
    arena.add_box({-10, 3.2, 0}, {2, 6.6, 0.2});
}

std::string complain(Plan plan, const gameplay::World& world) {
    try {
        complete_plan(plan, world);
    } catch (const PlanError& error) {
        return error.what();
    }
    return "";
}

TEST(Floors, KnowsARoom) {
    Arena arena;
    arena.add_room({0, 0, 0}, {4, 3, 4});
    arena.commit();
    Floors floors(arena.world(), plan_walker());
    const uint32_t node = floors.explore({2, 0, 2}, 1000);
    ASSERT_NE(node, Floors::kNone);
    EXPECT_EQ(floors.size(), 49u); // at 0.5 to 3.5
    EXPECT_LT(glm::distance(floors.place(node), Vec3(2, 0, 2)), 1e-6);
    EXPECT_EQ(floors.links(node).size(), 8u);
    EXPECT_EQ(floors.nearest({2.2, 1, 1.9}), node);
    EXPECT_EQ(floors.nearest({2, 2.5, 2}), Floors::kNone);
    EXPECT_EQ(floors.nearest({40, 0, 2}), Floors::kNone);
    EXPECT_EQ(floors.nearest({1e300, 0, NAN}), Floors::kNone);
}

TEST(Floors, EndsAtLedgesWallsAndLowCeilings) {
    Arena arena;
    arena.add_quad({0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0});
    arena.add_quad({4, -1, 0}, {4, -1, 4}, {8, -1, 4}, {8, -1, 0}); // a metre deeper
    arena.add_box({0, 0, 4}, {4, 1, 4.1});
    arena.add_box({-4, 1.5, 0}, {0, 1.6, 4}); // a ceiling over
    arena.add_quad({-4, 0, 0}, {-4, 0, 4}, {0, 0, 4}, {0, 0, 0});
    arena.commit();
    Floors floors(arena.world(), plan_walker());
    ASSERT_NE(floors.explore({2, 0, 2}, 1000), Floors::kNone);
    for (uint32_t i = 0; i < floors.size(); ++i) {
        EXPECT_GT(floors.place(i).x, 0.2);
        EXPECT_LE(floors.place(i).x, 4);
        EXPECT_LT(floors.place(i).z, 3.75);
        EXPECT_NEAR(floors.place(i).y, 0, 1e-6);
    }
    EXPECT_EQ(floors.explore({-2, 0, 2}, 1000), Floors::kNone);
}

TEST(Floors, IsCapped) {
    Arena arena;
    arena.add_floor(1000);
    arena.commit();
    Floors floors(arena.world(), plan_walker());
    floors.explore({0, 0, 0}, 500);
    EXPECT_GE(floors.size(), 500u);
    EXPECT_LT(floors.size(), 510u);
    floors.explore({0, 0, 0}, 900); // goes on
    EXPECT_GE(floors.size(), 900u);
}

TEST(Way, GoesAroundWallsAndUpStairs) {
    Arena arena;
    add_house(arena);
    arena.commit();
    Floors floors(arena.world(), plan_walker());
    floors.explore({-8, 0, -8}, 100000);
    const Vec3 from(-8, 0, -8), to(-8, 3.2, -8);
    const std::vector<Vec3> way = find_way(floors, from, to);
    ASSERT_GT(way.size(), 60u); // there and back again
    EXPECT_LT(glm::distance(way.front(), from), 0.5);
    EXPECT_LT(glm::distance(way.back(), to), 0.5);
    for (size_t i = 1; i < way.size(); ++i)
        EXPECT_LT(glm::distance(way[i - 1], way[i]), 1.01); // up to 45 degrees
}

TEST(Way, IsAsLongAsTheDistance) {
    Arena arena;
    add_house(arena);
    arena.commit();
    Floors floors(arena.world(), plan_walker());
    const uint32_t from = floors.explore({-8, 0, -8}, 100000);
    const std::vector<double> distances = three_cores::distances_from(floors, from);
    for (uint32_t to = 0; to < floors.size(); to += 37) {
        ASSERT_TRUE(std::isfinite(distances[to])); // one flood: all is linked
        const std::vector<uint32_t> way = find_way(floors, from, to);
        ASSERT_FALSE(way.empty());
        double sum = 0; // a way's length, longer beside walls
        for (size_t i = 1; i < way.size(); ++i)
            sum += glm::distance(floors.place(way[i - 1]), floors.place(way[i]))
                   * (floors.links(way[i]).size() < 8 ? 1.25 : 1);
        EXPECT_NEAR(sum, distances[to], 1e-9);
    }
}

TEST(Way, EndsWhereNoneLeads) {
    Arena arena;
    arena.add_room({0, 0, 0}, {10, 3, 4});
    arena.commit();
    Floors floors(arena.world(), plan_walker());
    floors.explore({2, 0, 2}, 1000);
    EXPECT_FALSE(find_way(floors, Vec3(2, 0, 2), {8, 0, 2}).empty());
    EXPECT_TRUE(find_way(floors, Vec3(2, 0, 2), {80, 0, 2}).empty());
    const uint32_t left = floors.nearest({4, 0, 2}), right = floors.nearest({4, 0, 3});
    EXPECT_EQ(find_way(floors, left, left).size(), 1u);
    EXPECT_EQ(find_way(floors, left, right).size(), 3u);
}

TEST(ThreeCoresPlan, FindsAHouseItsPlaces) {
    uint64_t first = 0;
    for (const rt_isa isa : {RT_ISA_BEST, RT_ISA_BEST, RT_ISA_SCALAR, RT_ISA_AVX2}) {
        Arena arena(isa);
        if (!arena.is_supported()) continue;
        add_house(arena);
        arena.commit();
        Plan plan = unplanned({-10, 0, -10}, {10, 6.6, 10});
        complete_plan(plan, arena.world());
        ASSERT_EQ(plan.spawns.size(), 1u);
        ASSERT_EQ(plan.cores.size(), 3u);
        ASSERT_EQ(plan.exits.size(), 1u);
        EXPECT_GE(plan.patrols.size(), 3u);
        for (size_t i = 0; i < 3; ++i) {
            EXPECT_GT(glm::distance(plan.cores[i], plan.cores[(i + 1) % 3]), 3); // a storey
            EXPECT_GT(glm::distance(plan.cores[i], plan.spawns[0].feet), 3);
            EXPECT_GT(glm::distance(plan.cores[i], plan.exits[0]), 3);
        }
        EXPECT_LT(plan.spawns[0].feet.y, 3.3); // not on the roof
        expect_free_rounds(arena.world(), plan);
        const Walk walk = walk_plan(arena.world(), plan);
        EXPECT_EQ(walk.goals, 4u);
        EXPECT_EQ(walk.reached, 4u);
        if (first == 0) first = hash(plan);
        EXPECT_EQ(hash(plan), first);
    }
}

TEST(ThreeCoresPlan, LeavesWhatTheLevelNames) {
    Arena arena;
    add_house(arena);
    arena.commit();
    Plan plan = unplanned({-10, 0, -10}, {10, 6.6, 10});
    plan.spawns = {{{-8, 0, -8}, {1, 0, 0}}};
    plan.cores = {{0, 1, 0}};
    complete_plan(plan, arena.world());
    ASSERT_EQ(plan.cores.size(), 1u);
    EXPECT_EQ(plan.cores[0], Vec3(0, 1, 0));
    ASSERT_EQ(plan.spawns.size(), 1u);
    EXPECT_LT(glm::distance(plan.spawns[0].feet, Vec3(-8, 0, -8)), 1e-6);
    EXPECT_EQ(plan.spawns[0].forward, Vec3(1, 0, 0));
    ASSERT_EQ(plan.exits.size(), 1u);
    const uint64_t before = hash(plan);
    complete_plan(plan, arena.world()); // nothing is left to do
    EXPECT_EQ(hash(plan), before);
}

TEST(ThreeCoresPlan, BeginsWhereOneGetsFar) {
    Arena arena;
    add_house(arena);
    arena.add_box({20, 0, 0}, {21.2, 0.1, 1.2}); // a perch outside
    arena.commit();
    Plan plan = unplanned({-10, 0, -10}, {21, 6.6, 10});
    plan.spawns = {{{20.6, 0.1, 0.6}}, {{50, 0, 50}}, {{-8, 0, -8}}, {{8, 3.2, -8}}};
    complete_plan(plan, arena.world());
    ASSERT_EQ(plan.spawns.size(), 2u);
    EXPECT_LT(glm::distance(plan.spawns[0].feet, Vec3(-8, 0, -8)), 1e-6);
    EXPECT_LT(glm::distance(plan.spawns[1].feet, Vec3(8, 3.2, -8)), 1e-6);
}

TEST(ThreeCoresPlan, LooksElsewhereIfNoSpawnLeadsAnywhere) {
    Arena arena;
    add_house(arena);
    arena.add_box({20, 0, 0}, {21.2, 0.1, 1.2});
    arena.commit();
    Plan plan = unplanned({-10, 0, -10}, {21, 6.6, 10});
    plan.spawns = {{{20.6, 0.1, 0.6}}};
    plan.cores = {{500, 1, 500}}; // out of reach: not ours to judge
    complete_plan(plan, arena.world());
    ASSERT_EQ(plan.spawns.size(), 1u);
    EXPECT_LT(plan.spawns[0].feet.x, 10);
    EXPECT_EQ(plan.exits.size(), 1u);
}

TEST(ThreeCoresPlan, ManagesOneRoom) {
    Arena arena;
    arena.add_room({0, 0, 0}, {6, 3, 6});
    arena.commit();
    Plan plan = unplanned({0, 0, 0}, {6, 3, 6});
    complete_plan(plan, arena.world());
    EXPECT_EQ(plan.cores.size(), 3u);
    EXPECT_EQ(plan.patrols.size(), 1u);
    const Walk walk = walk_plan(arena.world(), plan);
    EXPECT_EQ(walk.reached, 4u);
}

TEST(ThreeCoresPlan, ManagesAPlainWithoutEnd) {
    Arena arena;
    arena.add_floor(1e5);
    arena.commit();
    Plan plan = unplanned({-1e5, 0, -1e5}, {1e5, 0, 1e5});
    complete_plan(plan, arena.world());
    EXPECT_EQ(plan.cores.size(), 3u);
    EXPECT_GE(plan.patrols.size(), 5u);
    expect_free_rounds(arena.world(), plan);
    const Walk walk = walk_plan(arena.world(), plan);
    EXPECT_EQ(walk.reached, 4u);
}

TEST(ThreeCoresPlan, SaysWhyThereIsNone) {
    Arena empty;
    empty.commit();
    EXPECT_NE(complain({}, empty.world()).find("no floor"), std::string::npos);
    EXPECT_NE(complain(unplanned({-5, -5, -5}, {5, 5, 5}), empty.world()).find("no floor"),
              std::string::npos);
    EXPECT_NE(complain(unplanned({-5, -5, -5}, {5, INFINITY, 5}), empty.world()).find("bounds"),
              std::string::npos);

    Arena steep; // a slope of 60 degrees
    steep.add_quad({-5, 0, -5}, {-5, 0, 5}, {5, 17, 5}, {5, 17, -5});
    steep.commit();
    EXPECT_NE(complain(unplanned({-5, 0, -5}, {5, 17, 5}), steep.world()).find("no floor"),
              std::string::npos);

    Arena perch;
    perch.add_box({-0.5, 0, -0.5}, {0.5, 1, 0.5});
    perch.commit();
    EXPECT_NE(complain(unplanned({-0.5, 0, -0.5}, {0.5, 1, 0.5}), perch.world()).find("too small"),
              std::string::npos);
}

} // namespace
} // namespace peregrine::test
