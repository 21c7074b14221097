#pragma once

#include "gameplay/body.h"

namespace peregrine::gameplay {

// Gets a body that stands before a step onto it, if it is no higher than the rules allow, and takes
// what it went from `motion` (in x and z). `ground` is the normal of what the body stands on. False
// changes nothing.
bool climb_step(const Body& body, const Vec3& ground, Vec3& position, Vec3& motion);

} // namespace peregrine::gameplay
