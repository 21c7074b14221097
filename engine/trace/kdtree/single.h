#pragma once

#include "trace/kdtree/target.h"
#include "trace/kernels.h"
#include "trace/reference_lists.h"
#include "trace/slabs.h"

namespace peregrine::trace::kdtree {

// Visits the leaves that the ray may touch, near ones first. `leaf(first, count, t_far)` may lower
// t_far to what is still of interest; it returns true to stop. Returns the number of nodes visited.
template <class Real, class Leaf>
uint32_t visit_leaves(const Target& target, Slabs<Real> ray, Leaf&& leaf) {
    struct Entry {
        uint32_t node;
        Real t_near, t_far;
    };
    Entry stack[accel::kdtree::kMaxDepth]; // one entry a level at most
    uint32_t depth = 0;
    uint32_t visited = 0;
    uint32_t index = 0;
    Real t_near = ray.t_near;
    Real t_far = ray.t_far;
    Real t_limit = ray.t_far;
    if (!(t_near <= t_far)) return visited;

    for (;;) {
        accel::kdtree::Node node = tree_of(target).nodes[index];
        ++visited;
        while (!node.is_leaf()) {
            const uint32_t k = node.axis();
            const Real t = (Real(node.split) - ray.origin[k]) * ray.inverse[k];
            const Real t_first = t - ray.margin[k];
            const Real t_last = t + ray.margin[k];
            const uint32_t from_right = ray.inverse[k] < 0;
            const uint32_t near_child = node.left_child() + from_right;
            const uint32_t far_child = node.left_child() + (from_right ^ 1);
            if (t_last < t_near) {
                index = far_child;
            } else {
                index = near_child;
                if (t_first <= t_far) {
                    stack[depth++] = {far_child, std::max(t_near, t_first), t_far};
                    t_far = std::min(t_far, t_last);
                }
            }
            node = tree_of(target).nodes[index];
            ++visited;
        }
        if (leaf(node.first_reference, node.reference_count(), t_limit)) return visited;
        do {
            if (depth == 0) return visited;
            const Entry& entry = stack[--depth];
            index = entry.node;
            t_near = entry.t_near;
            t_far = std::min(entry.t_far, t_limit);
        } while (t_near > t_far);
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

} // namespace peregrine::trace::kdtree
