#pragma once

#include <string>

#include "round.h"

namespace host::game {

// Plays a round that needs no player, as fast as it goes, and prints how it ended: "WON" or "LOST"
// and the hash of its last state. Returns the exit status: 0 won, 3 not won, 4 a replay went
// astray.
int play_unattended(Round& round);

// Throws InputError.
gameplay::Replay read_replay(const std::string& path);
void write_replay(const gameplay::Replay& replay, const std::string& path);

} // namespace host::game
