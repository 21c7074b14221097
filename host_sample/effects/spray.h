#pragma once

#include <vector>

#include <peregrine/rt.h>

#include "level.h"

namespace host {

// Drops that leap from each place spray_N of a level and fall, as they are after so many seconds.
void add_spray(const Level& level, double seconds, std::vector<rt_particle>& particles);

} // namespace host
