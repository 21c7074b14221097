#pragma once

#include "gameplay/three_cores/plan.h"

#include "aliases.h"

#include "../level.h"
#include "../upload.h"

namespace host::game {

constexpr double spawn_eye_height = 1.7; // of spawn_N above the floor

// What the level names for the game; complete_plan() finds the rest. The level was imported with
// is_moved() and uploaded. Lamps are rounded a little, since no two mathematical libraries agree on
// the cosine of a cone.
three_cores::Plan plan_from_level(const Level& level, const Uploaded& uploaded);

} // namespace host::game
