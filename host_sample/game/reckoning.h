#pragma once

#include "simulation.h"
#include "ui/screens.h"

namespace host::game {

// How a round ended, without level, difficulty and bests.
ui::EndScreen reckon(const Shown& shown, const three_cores::Game& game);

} // namespace host::game
