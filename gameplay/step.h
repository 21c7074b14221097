#pragma once

#include "gameplay/body.h"

namespace peregrine::gameplay {

// Gets a body that stands before a step onto it, if it is no higher than the rules allow, and takes
// what it went from `motion` (in x and z). False changes nothing.
bool climb_step(const Body& body, Vec3& position, Vec3& motion);

} // namespace peregrine::gameplay
