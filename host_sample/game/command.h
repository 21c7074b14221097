#pragma once

#include <optional>

#include "../options.h"

namespace host::game {

// The game, as the options want it: in a window, or without one and a player. Returns the exit
// status; nothing if there is no display and no game without one. Throws InputError or EngineError.
std::optional<int> run(const Options& options);

} // namespace host::game
