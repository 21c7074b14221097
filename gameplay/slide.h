#pragma once

#include "gameplay/body.h"

namespace peregrine::gameplay {

// Moves a body through the air along `motion`, sliding along what it meets; takes the part that led
// into it out of `velocity`.
void slide_in_air(const Body& body, Vec3& position, Vec3& velocity, Vec3 motion);

// Moves a body on the ground along `motion` (in x and z), following slopes, climbing steps and
// sliding along walls, never up what is too steep. False if walls held it back.
bool slide_on_ground(const Body& body, Vec3& position, Vec3 ground_normal, Vec3 motion);

} // namespace peregrine::gameplay
