#pragma once

#include "trace/bih/target.h"
#include "trace/kernels.h"
#include "trace/reference_lists.h"
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
        const Node& node = tree_of(target).nodes[index];
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

// For OneRay.
struct Single {
    template <bool Filtered, class Real>
    static Hit closest(const Target& target, const math::Ray& ray, const Filter& filter,
                       Real reach) {
        return closest_in_lists<Filtered>(target, tree_of(target).lists, ray, filter, reach,
                                          leaves);
    }
    template <bool Filtered, class Real>
    static bool occluded(const Target& target, const math::Ray& ray, const Filter& filter,
                         Real reach) {
        return occluded_in_lists<Filtered>(target, tree_of(target).lists, ray, filter, reach,
                                           leaves);
    }
    template <class Real>
    static void visit(const Target& target, const math::Ray& ray, Visitor& visitor, Real reach) {
        visit_lists(target, tree_of(target).lists, ray, visitor, reach, leaves);
    }

private:
    static constexpr auto leaves = [](const Target& target, const auto& ray, auto& leaf) {
        return visit_leaves(target, ray, leaf);
    };
};

} // namespace peregrine::trace::bih
