#pragma once

#include "level.h"
#include "stage.h"

namespace host {

// Describes a level to the engine, with an ambient light of the given strength and a background
// that suits it. Throws EngineError.
void upload_level(Stage& stage, const Level& level, float ambient);

} // namespace host
