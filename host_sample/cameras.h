#pragma once

#include <string>
#include <vector>

#include "level.h"

namespace host {

// The level's cameras, or one that frames its bounds: never empty.
std::vector<Viewpoint> usable_cameras(const Level& level);

// By name, else by index; the first for an empty text. Throws InputError.
size_t find_camera(const std::vector<Viewpoint>& cameras, const std::string& name_or_index);

// A light for levels that bring none.
Light default_light();

} // namespace host
