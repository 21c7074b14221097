#pragma once

#include "gameplay/three_cores/plan.h"

#include "aliases.h"

#include "../level.h"

namespace host::game {

// Tells levels apart by all that the game can meet or know in them; not by names or colours.
uint64_t hash_of(const three_cores::Plan& plan, const Level& level);

} // namespace host::game
