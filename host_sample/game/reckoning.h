#pragma once

#include "simulation.h"
#include "ui/screens.h"

namespace host::game {

// How a round ended and what it was like, without level, difficulty and bests.
// A round that was won, in a sentence.
std::string story_of(const three_cores::Status& status, uint32_t lives_total);

ui::EndScreen reckon(const Shown& shown, const three_cores::Game& game);

} // namespace host::game
