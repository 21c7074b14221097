#pragma once

#include "trace/world/world.h"

namespace peregrine::trace {

// What is left of the filter within an instance, whose mesh is seen as a whole or not at all.
inline bool sees(const Filter& filter, const Instance& instance) {
    return !filter.ignores(instance.mesh) && (instance.layer_mask & filter.layer_mask) != 0;
}

// The ray as the instance's triangles are asked about it; false if nothing is left of it.
inline bool within(const Instance& instance, const math::Ray& ray, const Position& position,
                   math::Ray& local) {
    if (instance.has_own_space())
        return to_local(instance.to_local, position.from(instance.origin), ray, local);
    local = ray;
    return true;
}

inline Filter filter_within(const Filter& filter, const Instance& instance) {
    Filter within = filter;
    within.layer_mask = ~0u;
    within.ignore_mesh = geometry::kNoTriangle;
    within.ignore_more = {};
    if (filter.alpha.present) within.alpha = instance.alpha;
    return within;
}

// Whether a hit of one part goes before that of another: the smaller t, then the smaller (mesh,
// triangle). Both numbers count through the world; `best` may be a miss.
inline bool goes_before(const World& world, float t, uint32_t triangle, float best_t,
                        uint32_t best) {
    if (triangle == geometry::kNoTriangle || t > best_t) return false;
    if (t < best_t || best == geometry::kNoTriangle) return true;
    const geometry::TriangleInfo a = info(world, triangle), b = info(world, best);
    return a.mesh < b.mesh || (a.mesh == b.mesh && a.primitive < b.primitive);
}

} // namespace peregrine::trace
