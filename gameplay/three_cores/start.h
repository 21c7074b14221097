#pragma once

#include "gameplay/three_cores/floors.h"
#include "gameplay/three_cores/plan.h"

namespace peregrine::three_cores {

// What walks where a plan is made for.
gameplay::CharacterRules walker();

// Puts the plan's spawns onto the floor, with room for a body; those without any go away.
void settle_spawns(Plan& plan, const gameplay::World& world);

constexpr size_t kFewPlaces = 16; // of a graph: no room for a game

// The plan's first spawn from which one gets far, or else the one from which one gets farthest.
// Nothing if there is no room around any.
std::optional<Spawn> choose_spawn(const Plan& plan, const gameplay::World& world);

// A floor with room around it, indoors if there is one, as near to the middle of the level as
// possible. Nothing if nobody can stand anywhere.
std::optional<Spawn> find_spawn(const Plan& plan, const gameplay::World& world);

} // namespace peregrine::three_cores
