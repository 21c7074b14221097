#pragma once

#include "level.h"
#include "options.h"
#include "stage.h"

namespace host {

// A layer over the scene's lowest place, of a grey that goes with the ambient light. Throws
// EngineError.
void set_fog(Stage& stage, const Level& level, const Fog& fog, float ambient);

} // namespace host
