#pragma once

#include "gameplay/grenade.h"
#include "gameplay/random.h"
#include "support/arena.h"

#include <vector>

namespace peregrine::test {

struct Throw {
    Vec3 position, velocity;
};

// From anywhere in a box, in any direction, up to `speed` m/s.
Throw random_throw(gameplay::Random& random, const Vec3& lower, const Vec3& upper, double speed);

// Kinetic energy, of turning as well, and height: m^2/s^2, at the last event.
double energy(const gameplay::Grenade& grenade);

// How far the surface of the ball is from the nearest triangle; at most `reach`.
double gap(const gameplay::World& world, const gameplay::Grenade& grenade, double reach = 0.1);

// A room of 10 x 4 x 10 m with steps, a ramp, a box and a sharp wedge.
void add_playground(Arena& arena);

} // namespace peregrine::test
