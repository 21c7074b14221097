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
    if (filter.alpha.present) within.alpha = instance.tests[uint32_t(filter.asks)];
    return within;
}

// Whether the name (mesh, triangle) of one is smaller. Both numbers count through the world; `best`
// may be kNoTriangle.
inline bool is_named_before(const World& world, uint32_t triangle, uint32_t best) {
    if (best == geometry::kNoTriangle) return true;
    const geometry::TriangleInfo a = info(world, triangle), b = info(world, best);
    return a.mesh < b.mesh || (a.mesh == b.mesh && a.primitive < b.primitive);
}

// Whether a ray's hit in one part goes before that in another, which may be a miss: the smaller t,
// then fronts before backs, then the smaller name.
inline bool goes_before(const World& world, float t, bool back_face, uint32_t triangle,
                        float best_t, bool best_back_face, uint32_t best) {
    if (t != best_t) return t < best_t;
    if (best != geometry::kNoTriangle && back_face != best_back_face) return best_back_face;
    return is_named_before(world, triangle, best);
}

} // namespace peregrine::trace
