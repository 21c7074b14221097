#pragma once

#include <glm/glm.hpp>

#include "level.h"

namespace host {

// Red, green and blue of all texels, linear; 1 without a texture.
glm::dvec3 mean_of(const Level& level, const TextureUse& use);

} // namespace host
