#pragma once

#include "gameplay/character.h"
#include "gameplay/three_cores/plan.h"

namespace peregrine::test {

// What walks where a plan leads.
gameplay::CharacterRules plan_walker();

uint64_t hash(const three_cores::Plan& plan);

// Of points of the plan, cores and exits: how many are there, and how many a character reaches
// that follows the ways which are found from the first spawn on, one after the other.
struct Walk {
    size_t goals = 0, reached = 0;
    double metres = 0;
};
Walk walk_plan(const gameplay::World& world, const three_cores::Plan& plan);

// Expects rounds of two to five points with free flight for a drone, and peace around the spawn.
void expect_free_rounds(const gameplay::World& world, const three_cores::Plan& plan);

// Metres along the rounds.
double length_of_rounds(const three_cores::Plan& plan);

} // namespace peregrine::test
