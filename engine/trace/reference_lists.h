#pragma once

#include "geometry/crossing.h"
#include "geometry/intersect.h"
#include "geometry/triangle.h"
#include "trace/kernels.h"
#include "trace/slabs.h"

#include <algorithm>

// One ray through a structure whose leaves are ranges of references to triangles.
// `visit(target, slabs, leaf)` calls leaf(first, count, t_limit) for each leaf that the ray may
// touch, until that returns true, and returns the number of nodes visited.
namespace peregrine::trace {

struct ReferenceLists {
    const uint32_t* references;
    const geometry::Triangle* triangles;
};

template <bool Filtered, class Real, class Visit>
Hit closest_in_lists(const Target& target, const ReferenceLists& lists, const math::Ray& ray,
                     const Filter& filter, Real reach, Visit&& visit) {
    geometry::ShearedRay sheared = geometry::shear(ray);
    Hit best = miss(0);
    const auto leaf = [&](uint32_t first, uint32_t count, Real& t_limit) {
        for (uint32_t i = first; i < first + count; ++i) {
            const uint32_t index = lists.references[i];
            const auto& triangle = lists.triangles[index];
            geometry::TriangleHit hit;
            if (!geometry::intersect(sheared, triangle.v0, triangle.v1, triangle.v2, hit)) continue;
            const uint32_t key = key_of(index, hit.back_face);
            if (!comes_first(hit.t, key, sheared.t_max, best.triangle)
                || (Filtered && !filter.accepts(triangle.info(), hit.back_face, hit.u, hit.v)))
                continue;
            best = {hit.t, hit.u, hit.v, key, false, 0};
            sheared.t_max = hit.t;
            t_limit = std::min(t_limit, Real(hit.t));
        }
        return false;
    };
    best.steps = visit(target, slabs<Real>(target.bounds, ray, reach), leaf);
    name(best);
    return best;
}

template <bool Filtered, class Real, class Visit>
bool occluded_in_lists(const Target& target, const ReferenceLists& lists, const math::Ray& ray,
                       const Filter& filter, Real reach, Visit&& visit) {
    const geometry::ShearedRay sheared = geometry::shear(ray);
    bool occluded = false;
    const auto leaf = [&](uint32_t first, uint32_t count, Real&) {
        for (uint32_t i = first; i < first + count; ++i) {
            const auto& triangle = lists.triangles[lists.references[i]];
            geometry::TriangleHit hit;
            if (geometry::intersect(sheared, triangle.v0, triangle.v1, triangle.v2, hit)
                && (!Filtered || filter.accepts(triangle.info(), hit.back_face, hit.u, hit.v)))
                return occluded = true;
        }
        return false;
    };
    visit(target, slabs<Real>(target.bounds, ray, reach), leaf);
    return occluded;
}

template <class Real, class Visit>
void visit_lists(const Target& target, const ReferenceLists& lists, const math::Ray& ray,
                 Visitor& visitor, Real reach, Visit&& visit) {
    geometry::ShearedRay sheared = geometry::shear(ray);
    const auto leaf = [&](uint32_t first, uint32_t count, Real& t_limit) {
        visitor.counters.triangles += count;
        for (uint32_t i = first; i < first + count; ++i) {
            const auto& [v0, mesh, v1, primitive, v2, flags] = lists.triangles[lists.references[i]];
            geometry::TriangleHit hit;
            if (!geometry::intersect(sheared, v0, v1, v2, hit)
                || (visitor.wants_crossings() && !geometry::is_crossed(sheared, v0, v1, v2)))
                continue;
            sheared.t_max = std::min(sheared.t_max, visitor.see(lists.references[i], hit));
            t_limit = std::min(t_limit, Real(sheared.t_max));
        }
        return !(sheared.t_min <= sheared.t_max);
    };
    visitor.counters.nodes += visit(target, slabs<Real>(target.bounds, ray, reach), leaf);
}

} // namespace peregrine::trace
