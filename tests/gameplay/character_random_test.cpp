// Long walks at random: never out of the room, never overlapping, the same to the bit.
#include "support/arena.h"
#include "support/wanderer.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

using gameplay::Character;
using gameplay::CharacterInput;

constexpr double kStep = 1.0 / 60;

// A closed room with stairs, a ramp, pillars, a duct, a loft, slopes that are too steep, a low
// ceiling.
void furnish(Arena& arena) {
    arena.add_room({-8, 0, -8}, {8, 5, 8});
    for (int i = 0; i < 8; ++i)
        arena.add_box({-7.5 + 0.3 * i, 0, 5}, {-5.1 + 2.4, 0.3 * (i + 1), 7.5});
    arena.add_box({-2.7, 2.2, 4}, {3, 2.4, 8});                         // the loft
    arena.add_quad({3, 2.4, 5}, {3, 2.4, 7}, {7, 0, 7}, {7, 0, 5});     // a ramp down
    arena.add_quad({-8, 3, -8}, {-8, 3, -4}, {-6, 0, -4}, {-6, 0, -8}); // too steep
    arena.add_quad({8, 4, -8}, {3, 0.5, -8}, {3, 0.5, -3}, {8, 4, -3}); // low ceiling
    for (int i = 0; i < 6; ++i) // pillars, some with gaps hardly wider than a body
        arena.add_box({-3 + 0.9 * i, 0, -0.5}, {-2.7 + 0.9 * i, 3, -0.2 + 0.1 * i});
    arena.add_quad({0, 0, -8}, {0, 2, -8}, {2, 2, -5}, {2, 0, -5}); // an acute wedge
    arena.add_box({-1, 1.1, 1}, {1, 1.3, 3});                       // a table
    arena.add_triangle({5, 0, 0}, {5.5, 1.2, 0.7}, {6, 0, 0.3});    // a spike
    arena.commit();
}

TEST(CharacterRandom, StaysInAClosedRoomForTenMinutes) {
    Arena arena;
    furnish(arena);
    Character character = standing(arena.world(), {0, 0.1, -2});
    Wanderer wanderer(1);
    double way = 0, highest = 0;
    int overlaps = 0;
    for (int i = 0; i < 10 * 60 * 60; ++i) {
        const Vec3 before = character.state().position;
        character.update(wanderer.next(), kStep);
        const Vec3 p = character.state().position;
        ASSERT_GT(p.y, -0.01) << i;
        ASSERT_LT(p.y + character.state().height, 5) << i;
        ASSERT_LT(std::max(std::abs(p.x), std::abs(p.z)), 7.7 + 1e-6) << i;
        // Nothing is faster than its speed, its fall and a step, once it is climbed.
        ASSERT_LT(glm::length(p - before), 0.6) << i;
        overlaps += arena.world().overlaps(character.capsule());
        EXPECT_FALSE(character.state().squeezed) << i;
        way += glm::length(p - before);
        highest = std::max(highest, p.y);
    }
    EXPECT_EQ(overlaps, 0);
    EXPECT_GT(way, 600); // it did walk, and got up to the loft
    EXPECT_GT(highest, 2.3);
}

uint64_t wander(const gameplay::World& world, uint32_t seed, int steps) {
    Character character = standing(world, {0, 0.1, -2});
    Wanderer wanderer(seed);
    gameplay::StateHash all;
    for (int i = 0; i < steps; ++i) {
        character.update(wanderer.next(), kStep);
        add(all, character.state());
    }
    return all.value();
}

TEST(CharacterRandom, IsTheSameToTheBit) {
    Arena arena;
    furnish(arena);
    const uint64_t expected = wander(arena.world(), 7, 3000);
    EXPECT_EQ(wander(arena.world(), 7, 3000), expected);
    EXPECT_NE(wander(arena.world(), 8, 3000), expected);
    for (const rt_isa isa : {RT_ISA_SCALAR, RT_ISA_SSE4, RT_ISA_AVX2}) {
        Arena other(isa);
        if (!other.is_supported()) continue;
        furnish(other);
        EXPECT_EQ(wander(other.world(), 7, 3000), expected) << isa;
    }
}

TEST(CharacterRandom, GoesOnFromASavedState) {
    Arena arena;
    furnish(arena);
    Wanderer wanderer(3);
    Character first = standing(arena.world(), {0, 0.1, -2});
    for (int i = 0; i < 500; ++i) first.update(wanderer.next(), kStep);
    Character second(arena.world());
    second.restore(first.state());
    for (int i = 0; i < 500; ++i) {
        const CharacterInput input = wanderer.next();
        first.update(input, kStep);
        second.update(input, kStep);
        ASSERT_EQ(hash(second.state()), hash(first.state())) << i;
    }
}

} // namespace
} // namespace peregrine::test
