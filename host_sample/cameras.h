#pragma once

#include <optional>
#include <string>
#include <vector>

#include "level.h"

namespace host {

// From a node's place: along its -Z with +Y up. Nothing if its transform is flat or not finite.
std::optional<Viewpoint> look_along(const glm::dmat4& world);

// The level's cameras, or one that frames its bounds: never empty.
std::vector<Viewpoint> usable_cameras(const Level& level);

// By name, else by index; the first for an empty text. Throws InputError.
size_t find_camera(const std::vector<Viewpoint>& cameras, const std::string& name_or_index);

// A light for levels that bring none.
Light default_light();

} // namespace host
