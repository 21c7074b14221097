#pragma once

#include "trace/world/world.h"

// One ray through all parts of a world. A world in which nothing moves costs one branch more than
// its one structure.
namespace peregrine::trace {

Hit closest_of_moving(const World& world, const math::Ray& ray, const Filter& filter, Hit best);
bool occluded_by_moving(const World& world, const math::Ray& ray, const Filter& filter);

inline Hit closest(const World& world, const math::Ray& ray, const Filter& filter) {
    const Hit hit = world.fixed.kernels->closest(world.fixed.target, ray, filter);
    return world.moves ? closest_of_moving(world, ray, filter, hit) : hit;
}

inline bool occluded(const World& world, const math::Ray& ray, const Filter& filter) {
    return world.fixed.kernels->occluded(world.fixed.target, ray, filter)
           || (world.moves && occluded_by_moving(world, ray, filter));
}

} // namespace peregrine::trace
