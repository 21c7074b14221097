#pragma once

#include "gameplay/world.h"

namespace peregrine::gameplay {

// Where a sphere that overlaps surfaces gets free of them, going the shortest way off one after the
// other; where that never ends (a gap narrower than the sphere), some place between them. The side
// of a surface that the centre is on is the outside.
Vec3 push_out(const World& world, const Capsule& sphere, const Mask& mask = {});

} // namespace peregrine::gameplay
