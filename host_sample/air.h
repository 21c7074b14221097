#pragma once

#include <cstdint>
#include <vector>

#include <peregrine/rt.h>

#include "level.h"
#include "options.h"
#include "stage.h"

namespace host {

// A layer over the scene's lowest place, of a grey that goes with the ambient light. Throws
// EngineError.
void set_fog(Stage& stage, const Level& level, const Fog& fog, float ambient);

// Lets fog scatter so much of what it takes from the lamps' light: of those that end somewhere.
void light_fog(Level& level, float part);

// Embers above the lamps of a level, as they are after so many seconds: the same for the same
// arguments.
std::vector<rt_particle> make_embers(const Level& level, uint32_t count, double seconds);

} // namespace host
