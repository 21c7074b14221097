#pragma once

#include "trace/world/world.h"

// One ray through all parts of a world. A world in which nothing moves costs one branch more than
// its one structure.
namespace peregrine::trace {

Hit closest_of_parts(const World& world, const math::Ray& ray, const Position& position,
                     const Filter& filter);
bool occluded_by_parts(const World& world, const math::Ray& ray, const Position& position,
                       const Filter& filter);

// The kernel's hit goes to the caller as it is: a copy on the way would wait for its stores. The
// position of a ray that is not relative to anything is its origin.
inline Hit closest(const World& world, const math::Ray& ray, const Position& position,
                   const Filter& filter) {
    if (world.nodes) return closest_of_parts(world, ray, position, filter);
    return world.fixed.kernels->closest(world.fixed.target, ray, filter);
}

inline Hit closest(const World& world, const math::Ray& ray, const Filter& filter) {
    if (world.nodes) return closest_of_parts(world, ray, {ray.origin}, filter);
    return world.fixed.kernels->closest(world.fixed.target, ray, filter);
}

inline bool occluded(const World& world, const math::Ray& ray, const Position& position,
                     const Filter& filter) {
    if (world.nodes) return occluded_by_parts(world, ray, position, filter);
    return world.fixed.kernels->occluded(world.fixed.target, ray, filter);
}

inline bool occluded(const World& world, const math::Ray& ray, const Filter& filter) {
    if (world.nodes) return occluded_by_parts(world, ray, {ray.origin}, filter);
    return world.fixed.kernels->occluded(world.fixed.target, ray, filter);
}

} // namespace peregrine::trace
