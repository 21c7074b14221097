#pragma once

#include <cstdint>
#include <vector>

#include <peregrine/rt.h>

#include "level.h"

namespace host {

// As it is after so many seconds, `number` telling it from the others of its lamp: embers rise and
// fade, again and again.
rt_particle make_ember(const Light& lamp, uint32_t number, double seconds);

// So many above all lamps of a level that are points.
std::vector<rt_particle> make_embers(const Level& level, uint32_t count, double seconds);

} // namespace host
