#pragma once

#include "accel/bih/tree.h"
#include "geometry/intersect.h"
#include "trace/kernels.h"
#include "trace/slabs.h"

// One ray through the bounding interval hierarchy, in float or double.
//
// Why nothing is missed: a triangle of a child lies whole on the child's side of its planes, so the
// witness P of a hit on it (trace/slabs.h) does too, and each plane is a split s with P_k <= s or
// P_k >= s. The clip planes are coordinates of vertices, hence exact and within the bounds that the
// margin's D is measured by. An interval cut at (s - origin_k) / d_k, moved outwards by margin_k,
// thus keeps the t of every hit of that child; intervals that are intersections of such keep it
// too.
namespace peregrine::trace::bih {

using accel::bih::Node;

template <class Real>
struct Interval {
    Real t_near, t_far;
    bool empty() const { return !(t_near <= t_far); }
};

template <class Real>
struct Entry {
    uint32_t node;
    Interval<Real> interval;
};

// Visits the leaves that the ray may touch, near ones first where children do not overlap.
// `leaf(first, count, t_limit)` may lower t_limit; it returns true to stop. Returns the number of
// nodes visited.
template <class Real, class Leaf>
uint32_t visit_leaves(const Target& target, const Slabs<Real>& ray, Leaf&& leaf) {
    Entry<Real> stack[accel::bih::kMaxDepth]; // an inner node leaves one child behind at most
    uint32_t depth = 0;
    uint32_t visited = 0;
    uint32_t index = 0;
    Real t_limit = ray.t_far;
    Interval<Real> current{ray.t_near, ray.t_far};
    if (current.empty()) return 0;

    for (;;) {
        const Node& node = target.bih_nodes[index];
        ++visited;
        if (node.is_leaf()) {
            if (leaf(node.first_reference(), node.reference_count(), t_limit)) return visited;
            current = {1, 0};
        } else {
            const uint32_t k = node.axis();
            const uint32_t backwards = ray.inverse[k] < 0;
            const Real first = (Real(node.clip[backwards]) - ray.origin[k]) * ray.inverse[k];
            const Real second = (Real(node.clip[backwards ^ 1]) - ray.origin[k]) * ray.inverse[k];
            if (node.is_cut()) {
                index = node.child();
                current.t_near = std::max(current.t_near, first - ray.margin[k]);
                current.t_far = std::min(current.t_far, second + ray.margin[k]);
            } else {
                const Interval<Real> far{std::max(current.t_near, second - ray.margin[k]),
                                         current.t_far};
                const uint32_t far_child = node.child() + (backwards ^ 1);
                current.t_far = std::min(current.t_far, first + ray.margin[k]);
                index = node.child() + backwards;
                if (current.empty()) {
                    current = far;
                    index = far_child;
                } else if (!far.empty()) {
                    stack[depth++] = {far_child, far};
                }
            }
        }
        while (current.empty()) {
            if (depth == 0) return visited;
            const Entry<Real>& entry = stack[--depth];
            index = entry.node;
            current = {entry.interval.t_near, std::min(entry.interval.t_far, t_limit)};
        }
    }
}

template <bool Filtered, class Real>
Hit closest_plain(const Target& target, const math::Ray& ray, const Filter& filter, Real reach) {
    geometry::ShearedRay sheared = geometry::shear(ray);
    uint32_t best = geometry::kNoTriangle;
    geometry::TriangleHit found{};
    const uint32_t steps = visit_leaves(
        target, slabs<Real>(target.bounds, ray, reach),
        [&](uint32_t first, uint32_t count, Real& t_limit) {
            for (uint32_t i = first; i < first + count; ++i) {
                const uint32_t index = target.bih_references[i];
                const auto& triangle = target.triangles[index];
                geometry::TriangleHit hit;
                if (!geometry::intersect(sheared, triangle.v0, triangle.v1, triangle.v2, hit)
                    || !comes_first(hit.t, index, sheared.t_max, best))
                    continue;
                if (Filtered && !filter.accepts(triangle.info(), hit.back_face, hit.u, hit.v))
                    continue;
                best = index;
                found = hit;
                sheared.t_max = hit.t;
                t_limit = std::min(t_limit, Real(hit.t));
            }
            return false;
        });
    if (best == geometry::kNoTriangle) return miss(steps);
    return {found.t, found.u, found.v, best, found.back_face, steps};
}

template <bool Filtered, class Real>
bool occluded_plain(const Target& target, const math::Ray& ray, const Filter& filter, Real reach) {
    const geometry::ShearedRay sheared = geometry::shear(ray);
    bool occluded = false;
    visit_leaves(
        target, slabs<Real>(target.bounds, ray, reach), [&](uint32_t first, uint32_t count, Real&) {
            for (uint32_t i = first; i < first + count; ++i) {
                const auto& triangle = target.triangles[target.bih_references[i]];
                geometry::TriangleHit hit;
                if (geometry::intersect(sheared, triangle.v0, triangle.v1, triangle.v2, hit)
                    && (!Filtered || filter.accepts(triangle.info(), hit.back_face, hit.u, hit.v)))
                    return occluded = true;
            }
            return false;
        });
    return occluded;
}

} // namespace peregrine::trace::bih
