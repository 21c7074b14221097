#pragma once

#include "gameplay/grenade.h"

// The cheap grenade of Arauna (Bikker, "Real-time ray tracing through the eyes of a game
// developer", section 3.1): a ray a step instead of a sphere's sweeps, and steps instead of events.
// Good enough for sparks and shells. It may cut corners, sink into edges, and goes another way at
// another time step: `peregrine_bench grenade` says how far.
namespace peregrine::gameplay {

struct RayGrenade {
    Vec3 position{0};
    Vec3 velocity{0};
};

void step(const World& world, const GrenadeRules& rules, RayGrenade& grenade, double seconds);

} // namespace peregrine::gameplay
