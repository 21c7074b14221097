// One question at a time, for tests that are about something else.
#pragma once

#include "support.h"

namespace peregrine::test {

inline rt_hit trace_one(rt_scene scene, const rt_ray& ray,
                        const rt_query_options* options = nullptr, rt_surface* surface = nullptr) {
    rt_hit hit{};
    rt_query_desc desc = rt_default_query_desc();
    desc.rays = &ray;
    desc.ray_count = 1;
    desc.hits = &hit;
    desc.surfaces = surface;
    desc.surface_fields = RT_SURFACE_ALL;
    desc.options = options;
    EXPECT_OK(rt_trace_query(scene, &desc));
    return hit;
}

inline rt_sweep_hit sweep_one(rt_scene scene, const rt_sweep& sweep,
                              const rt_query_options* options = nullptr) {
    rt_sweep_hit hit{};
    rt_sweep_desc desc = rt_default_sweep_desc();
    desc.sweeps = &sweep;
    desc.sweep_count = 1;
    desc.hits = &hit;
    desc.options = options;
    EXPECT_OK(rt_sweep_shapes(scene, &desc));
    return hit;
}

inline bool overlaps_one(rt_scene scene, const rt_shape& shape,
                         const rt_query_options* options = nullptr) {
    uint8_t overlapping = 7;
    rt_overlap_desc desc = rt_default_overlap_desc();
    desc.shapes = &shape;
    desc.shape_count = 1;
    desc.overlapping = &overlapping;
    desc.options = options;
    EXPECT_OK(rt_overlap_shapes(scene, &desc));
    EXPECT_LE(overlapping, 1);
    return overlapping == 1;
}

inline rt_nearest nearest_one(rt_scene scene, const rt_point& point,
                              const rt_query_options* options = nullptr) {
    rt_nearest nearest{};
    rt_nearest_desc desc = rt_default_nearest_desc();
    desc.points = &point;
    desc.point_count = 1;
    desc.results = &nearest;
    desc.options = options;
    EXPECT_OK(rt_find_nearest(scene, &desc));
    return nearest;
}

} // namespace peregrine::test
