#pragma once

#include "geometry/triangle.h"
#include "level.h"

#include <vector>

namespace peregrine::bench {

// All triangles of a level as it stands at the start of its animations, those of what moves, too.
std::vector<geometry::Triangle> standing_triangles(const host::Level& level);

} // namespace peregrine::bench
