#pragma once

#include "gameplay/body.h"

namespace peregrine::gameplay {

// What carries a body.
struct Ground {
    Vec3 position; // of the body on it
    Vec3 normal;   // of the plane to walk along
    Vec3 point;
    rt_mesh mesh;
};

// The ground at most `drop` below. Slopes beyond the limit carry nobody, except where two of them
// meet in a valley that is no steeper than the limit, or three in a pit. An edge carries if the
// normal there points upwards by `least_edge` (a sine): 0 for who climbs it, more for who falls, so
// that no ledge is caught with the side of the body.
std::optional<Ground> find_ground(const Body& body, const Vec3& position, double drop,
                                  double least_edge = 0);

} // namespace peregrine::gameplay
