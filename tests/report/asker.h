#pragma once

#include "stage.h"

#include <peregrine/rt.h>

#include <vector>

namespace peregrine::report {

// A level and the questions that the pictures ask.
class Asker {
public:
    explicit Asker(const host::Stage& stage) : stage_(stage) {}

    std::vector<rt_hit> closest(const std::vector<rt_ray>& rays) const {
        std::vector<rt_hit> hits(rays.size());
        rt_query_desc desc = describe(rays);
        desc.hits = hits.data();
        check(stage_.api().trace_query(stage_.scene(), &desc));
        return hits;
    }
    std::vector<uint8_t> any(const std::vector<rt_ray>& rays) const {
        std::vector<uint8_t> occluded(rays.size());
        rt_query_desc desc = describe(rays);
        desc.kind = RT_QUERY_ANY;
        desc.occluded = occluded.data();
        check(stage_.api().trace_query(stage_.scene(), &desc));
        return occluded;
    }
    std::vector<rt_hit> all(const rt_ray& ray, uint32_t most) const {
        std::vector<rt_hit> hits(most);
        uint32_t count = 0;
        rt_query_desc desc = rt_default_query_desc();
        desc.kind = RT_QUERY_ALL;
        desc.rays = &ray;
        desc.ray_count = 1;
        desc.hits = hits.data();
        desc.hit_counts = &count;
        desc.max_hits = most;
        check(stage_.api().trace_query(stage_.scene(), &desc));
        hits.resize(count);
        return hits;
    }
    std::vector<uint32_t> count(const std::vector<rt_ray>& rays) const {
        std::vector<uint32_t> counts(rays.size());
        rt_query_desc desc = describe(rays);
        desc.kind = RT_QUERY_COUNT;
        desc.hit_counts = counts.data();
        check(stage_.api().trace_query(stage_.scene(), &desc));
        return counts;
    }
    std::vector<rt_sweep_hit> sweep(const std::vector<rt_sweep>& sweeps) const {
        std::vector<rt_sweep_hit> hits(sweeps.size());
        rt_sweep_desc desc = rt_default_sweep_desc();
        desc.sweeps = sweeps.data();
        desc.sweep_count = sweeps.size();
        desc.hits = hits.data();
        check(stage_.api().sweep_shapes(stage_.scene(), &desc));
        return hits;
    }
    std::vector<uint8_t> overlap(const std::vector<rt_shape>& shapes) const {
        std::vector<uint8_t> overlapping(shapes.size());
        rt_overlap_desc desc = rt_default_overlap_desc();
        desc.shapes = shapes.data();
        desc.shape_count = shapes.size();
        desc.overlapping = overlapping.data();
        check(stage_.api().overlap_shapes(stage_.scene(), &desc));
        return overlapping;
    }
    std::vector<rt_nearest> nearest(const std::vector<rt_point>& points) const {
        std::vector<rt_nearest> found(points.size());
        rt_nearest_desc desc = rt_default_nearest_desc();
        desc.points = points.data();
        desc.point_count = points.size();
        desc.results = found.data();
        check(stage_.api().find_nearest(stage_.scene(), &desc));
        return found;
    }

private:
    static rt_query_desc describe(const std::vector<rt_ray>& rays) {
        rt_query_desc desc = rt_default_query_desc();
        desc.rays = rays.data();
        desc.ray_count = rays.size();
        return desc;
    }
    void check(rt_result result) const { stage_.check(result, "query"); }

    const host::Stage& stage_;
};

} // namespace peregrine::report
