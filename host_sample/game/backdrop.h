#pragma once

#include <span>

#include "../level.h"

namespace host::game {

// The picture behind the title: from each camera for a while, looking slowly from side to side.
// `cameras` is not empty.
Viewpoint backdrop(std::span<const Viewpoint> cameras, double seconds);

} // namespace host::game
