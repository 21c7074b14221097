#pragma once

#include "query/hit_names.h"
#include "query/valid_ray.h"
#include "scene/snapshot.h"
#include "trace/world/single.h"

// One ray: the short way, small enough to be part of its caller. Both throw base::Error
// invalid_argument, as query.h says.
namespace peregrine::query {

inline constexpr trace::Filter kEverything;

// A ray that is relative to a point comes with its position.
template <class... Position>
[[gnu::always_inline]] inline void closest_hit(const scene::Snapshot& snapshot,
                                               const trace::Filter& filter, std::byte* place,
                                               const math::Ray& ray, const Position&... position) {
    check_ray(0, ray);
    const trace::Hit hit = trace::closest(snapshot.world, ray, position..., filter);
    store_hit(HitNames(snapshot).hit(hit), place);
}

template <class... Position>
[[gnu::always_inline]] inline bool occluded(const scene::Snapshot& snapshot,
                                            const trace::Filter& filter, const math::Ray& ray,
                                            const Position&... position) {
    check_ray(0, ray);
    return trace::occluded(snapshot.world, ray, position..., filter);
}

} // namespace peregrine::query
