#pragma once

#include "gameplay/world.h"

namespace peregrine::gameplay {

// How a sphere of even mass bounces. Impulses are per kilogram.
struct BounceRules {
    double radius = 0;
    double restitution = 0; // of the speed along the normal; 0 to 1
    double friction = 0;  // Coulomb's: the tangential impulse is at most this times the normal one
    double inertia = 0.4; // moment of inertia over mass radius^2: 0.4 a ball, 2/3 a shell
};

struct Spinning {
    Vec3 velocity{0};
    Vec3 spin{0}; // rad/s
};

// After meeting a surface at `approach` m/s along its normal. The energy never grows.
Spinning bounce(const BounceRules& rules, const Spinning& body, const Vec3& normal,
                double approach);

// Pressed on a surface, it stops slipping, and rolls; without friction nothing changes.
Spinning grip(const BounceRules& rules, const Spinning& body, const Vec3& normal);

} // namespace peregrine::gameplay
