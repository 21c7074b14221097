#pragma once

#include "geometry/crossing.h"
#include "geometry/intersect.h"
#include "trace/bvh/tree/decode.h"
#include "trace/kernels.h"
#include "trace/slabs.h"

// One ray through the wide BVH in plain C++, in float or double: for machines without SIMD kernels,
// and for rays whose numbers do not fit float.
namespace peregrine::trace::bvh {

template <class Real>
struct PlainEntry {
    Link link;
    Real t_near;
};

// The children that the ray may touch up to t_limit, near ones last.
template <class Real>
uint32_t enter(const Node& node, const Slabs<Real>& ray, Real t_limit, PlainEntry<Real>* out) {
    uint32_t count = 0;
    for (uint32_t child = 0; child < accel::bvh::kWidth; ++child) {
        if (!(node.lower[0][child] <= node.upper[0][child])) continue;
        Real t_near = ray.t_near, t_far = t_limit;
        for (int k = 0; k < 3; ++k) {
            const Real lower = (Real(node.lower[k][child]) - ray.origin[k]) * ray.inverse[k];
            const Real upper = (Real(node.upper[k][child]) - ray.origin[k]) * ray.inverse[k];
            t_near = std::max(t_near, std::min(lower, upper) - ray.margin[k]);
            t_far = std::min(t_far, std::max(lower, upper) + ray.margin[k]);
        }
        if (!(t_near <= t_far)) continue;
        uint32_t place = count++;
        for (; place > 0 && out[place - 1].t_near < t_near; --place) out[place] = out[place - 1];
        out[place] = {node.child[child], t_near};
    }
    return count;
}

// `test(block, lane, t_limit)` may lower t_limit; it returns true to stop. Returns the number of
// nodes visited.
template <class Real, class Test>
uint32_t visit_triangles(const Target& target, const Slabs<Real>& ray, Test&& test) {
    PlainEntry<Real> stack[accel::bvh::kStackSize];
    Real t_limit = ray.t_far;
    if (!(ray.t_near <= t_limit)) return 0;
    uint32_t visited = 0;
    uint32_t depth = 0;
    stack[depth++] = {Link::inner(0), ray.t_near};
    Node node_room;
    LeafRoom leaf_room;
    while (depth > 0) {
        const PlainEntry<Real> entry = stack[--depth];
        if (entry.t_near > t_limit) continue;
        if (!entry.link.is_leaf()) {
            const Node& node = plain_node(target, entry.link.node(), node_room);
            depth += enter(node, ray, t_limit, stack + depth);
            ++visited;
            continue;
        }
        const Leaf leaf = plain_leaf(target, entry.link, leaf_room);
        for (uint32_t i = 0; i < leaf.count; ++i)
            if (test(leaf.blocks[i / accel::bvh::kBlockWidth], i % accel::bvh::kBlockWidth,
                     t_limit))
                return visited;
    }
    return visited;
}

inline math::Vec3 vertex(const Block& block, uint32_t lane, int i) {
    return {block.vertex[i][0][lane], block.vertex[i][1][lane], block.vertex[i][2][lane]};
}

inline bool intersect(const geometry::ShearedRay& ray, const Block& block, uint32_t lane,
                      geometry::TriangleHit& hit) {
    return geometry::intersect(ray, vertex(block, lane, 0), vertex(block, lane, 1),
                               vertex(block, lane, 2), hit);
}

// Of a triangle that the ray hits: whether the visitor wants to see it.
inline bool is_wanted(const Visitor& visitor, const geometry::ShearedRay& ray, const Block& block,
                      uint32_t lane) {
    return !visitor.wants_crossings()
           || geometry::is_crossed(ray, vertex(block, lane, 0), vertex(block, lane, 1),
                                   vertex(block, lane, 2));
}

// For OneRay.
struct Plain {
    template <bool Filtered, class Real>
    static Hit closest(const Target& target, const math::Ray& ray, const Filter& filter,
                       Real reach) {
        geometry::ShearedRay sheared = geometry::shear(ray);
        Hit best = miss(0);
        const auto test = [&](const Block& block, uint32_t lane, Real& t_limit) {
            geometry::TriangleHit hit;
            if (!intersect(sheared, block, lane, hit)) return false;
            const uint32_t index = block.triangle[lane], key = key_of(index, hit.back_face);
            if (!comes_first(hit.t, key, sheared.t_max, best.triangle)
                || (Filtered && !filter.accepts(target.infos[index], hit.back_face, hit.u, hit.v)))
                return false;
            best = {hit.t, hit.u, hit.v, key, false, 0};
            sheared.t_max = hit.t;
            t_limit = std::min(t_limit, Real(hit.t));
            return false;
        };
        best.steps = visit_triangles(target, slabs(target.bounds, ray, reach), test);
        name(best);
        return best;
    }

    template <bool Filtered, class Real>
    static bool occluded(const Target& target, const math::Ray& ray, const Filter& filter,
                         Real reach) {
        const geometry::ShearedRay sheared = geometry::shear(ray);
        bool occluded = false;
        const auto test = [&](const Block& block, uint32_t lane, Real&) {
            geometry::TriangleHit hit;
            occluded = intersect(sheared, block, lane, hit)
                       && (!Filtered
                           || filter.accepts(target.infos[block.triangle[lane]], hit.back_face,
                                             hit.u, hit.v));
            return occluded;
        };
        visit_triangles(target, slabs(target.bounds, ray, reach), test);
        return occluded;
    }

    template <class Real>
    static void visit(const Target& target, const math::Ray& ray, Visitor& visitor, Real reach) {
        geometry::ShearedRay sheared = geometry::shear(ray);
        const auto test = [&](const Block& block, uint32_t lane, Real& t_limit) {
            ++visitor.counters.triangles;
            geometry::TriangleHit hit;
            if (!intersect(sheared, block, lane, hit) || !is_wanted(visitor, sheared, block, lane))
                return false;
            sheared.t_max = std::min(sheared.t_max, visitor.see(block.triangle[lane], hit));
            t_limit = std::min(t_limit, Real(sheared.t_max));
            return !(sheared.t_min <= sheared.t_max);
        };
        visitor.counters.nodes += visit_triangles(target, slabs(target.bounds, ray, reach), test);
    }
};

// For rays that SIMD kernels leave aside.
template <bool Filtered>
Hit closest_in_double(const Target& target, const math::Ray& ray, const Filter& filter) {
    return Plain::closest<Filtered>(target, ray, filter, reach<double>(target.bounds, ray.origin));
}
template <bool Filtered>
bool occluded_in_double(const Target& target, const math::Ray& ray, const Filter& filter) {
    return Plain::occluded<Filtered>(target, ray, filter, reach<double>(target.bounds, ray.origin));
}
inline void visit_in_double(const Target& target, const math::Ray& ray, Visitor& visitor) {
    Plain::visit(target, ray, visitor, reach<double>(target.bounds, ray.origin));
}

} // namespace peregrine::trace::bvh
