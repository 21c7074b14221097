// One ray through the wide BVH: eight boxes at a time, then four triangles at a
// time. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_SINGLE_SINGLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_SINGLE_SINGLE_INL_H
#undef PEREGRINE_TRACE_BVH_SINGLE_SINGLE_INL_H
#else
#define PEREGRINE_TRACE_BVH_SINGLE_SINGLE_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "trace/bvh/single/plain.h"
#include "trace/bvh/tree/block-inl.h"
#include "trace/bvh/tree/push-inl.h"
#include "trace/kernels.h"
#include "trace/slabs.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Goes through the nodes that the ray may touch up to t_max, roughly from near
// to far. `leaf(link)` may lower t_max. Returns the number of nodes visited.
template <class View, class Visit>
HWY_INLINE HWY_ATTR uint32_t visit_from_near(const View& view, const NodeRay& ray, float t_min,
                                             const float& t_max, Visit&& leaf) {
    uint64_t stack[accel::bvh::kStackSize];
    uint64_t* top = stack;
    uint32_t visited = 0;
    Link link = Link::inner(0);
    const V8 begin = hn::Set(k8, t_min);
    for (;;) {
        if (!link.is_leaf()) {
            const auto& node = view.node(link);
            hwy::Prefetch(node.child);
            const Entered entered(ray, node, begin, hn::Set(k8, t_max));
            ++visited;
            if (entered.children) {
                link = push(view, node, entered, top);
                continue;
            }
        } else {
            leaf(link);
        }
        do {
            if (top == stack) return visited;
            --top;
        } while (Entry::t_near(*top) > t_max);
        link = Entry::link(*top);
    }
}

// Goes through the nodes that the ray touches, in any order, leaves as soon as
// they are met. `leaf(link)` returns true to stop; so does this.
template <class View, class Visit>
HWY_INLINE HWY_ATTR bool visit_any(const View& view, const NodeRay& ray, float t_min, float t_max,
                                   Visit&& leaf) {
    using NodeType = typename View::NodeType;
    struct Level {
        const NodeType* node;
        uint32_t children; // still to visit
    };
    Level stack[accel::bvh::kMaxDepth];
    Level* top = stack;
    const NodeType* node = &view.node(Link::inner(0));
    const V8 begin = hn::Set(k8, t_min), end = hn::Set(k8, t_max);
    for (;;) {
        uint32_t children = Entered(ray, *node, begin, end).children;
        uint32_t leaves = children & leaves_of(*node);
        children ^= leaves;
        for (; leaves; leaves &= leaves - 1)
            if (leaf(node->child[std::countr_zero(leaves)])) return true;
        if (children == 0) {
            if (top == stack) return false;
            --top;
            node = top->node;
            children = top->children;
        }
        const uint32_t child = uint32_t(std::countr_zero(children));
        *top = {node, children & (children - 1)};
        if (top->children) {
            view.prefetch(node->child[std::countr_zero(top->children)]);
            ++top;
        }
        node = &view.node(node->child[child]);
    }
}

template <class View, bool Filtered>
HWY_ATTR Hit closest(const Target& target, const math::Ray& ray, const Filter& filter) {
    const RayLanes lanes(target.bounds, ray);
    if (!fits_float(hn::GetLane(lanes.largest), hn::GetLane(lanes.reach))) [[unlikely]]
        return closest_in_double<Filtered>(target, ray, filter);
    const NodeRay node_ray(lanes);
    const BlockRay block_ray(lanes, ray);
    float t_max = block_ray.t_max;
    Hit best = miss(0);
    const View view(target);
    LeafRoom room;
    const uint32_t steps = visit_from_near(
        view, node_ray, ray.t_min, t_max, [&](Link link) HWY_ATTR __attribute__((always_inline)) {
            const Leaf leaf = view.leaf(link, room);
            const Block* block = leaf.blocks;
            const Block* last = block + (leaf.count - 1) / accel::bvh::kBlockWidth;
            for (; block <= last; ++block) {
                BlockHits hits;
                if (!intersect(block_ray, *block, t_max, hits)) continue;
                for (uint32_t hit = hits.lanes; hit; hit &= hit - 1) {
                    const uint32_t i = uint32_t(std::countr_zero(hit));
                    const uint32_t index = block->triangle[i];
                    const bool back_face = hits.back_faces >> i & 1;
                    const uint32_t key = key_of(index, back_face);
                    if (!comes_first(hits.t[i], key, t_max, best.triangle)) continue;
                    if (Filtered
                        && !filter.accepts(target.infos[index], back_face, hits.u[i], hits.v[i]))
                        continue;
                    best = {hits.t[i], hits.u[i], hits.v[i], key, false, 0};
                    t_max = hits.t[i];
                }
            }
        });
    best.steps = steps;
    name(best);
    return best;
}

template <class View, bool Filtered>
HWY_ATTR bool occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
    const RayLanes lanes(target.bounds, ray);
    if (!fits_float(hn::GetLane(lanes.largest), hn::GetLane(lanes.reach))) [[unlikely]]
        return occluded_in_double<Filtered>(target, ray, filter);
    const NodeRay node_ray(lanes);
    const BlockRay block_ray(lanes, ray);
    const View view(target);
    LeafRoom room;
    return visit_any(
        view, node_ray, ray.t_min,
        block_ray.t_max, [&](Link link) HWY_ATTR __attribute__((always_inline)) {
            const Leaf leaf = view.leaf(link, room);
            const Block* block = leaf.blocks;
            const Block* last = block + (leaf.count - 1) / accel::bvh::kBlockWidth;
            for (; block <= last; ++block) {
                if (!Filtered) {
                    if (intersects(block_ray, *block)) return true;
                    continue;
                }
                BlockHits hits;
                if (!intersect(block_ray, *block, block_ray.t_max, hits)) continue;
                for (uint32_t hit = hits.lanes; hit; hit &= hit - 1) {
                    const uint32_t i = uint32_t(std::countr_zero(hit));
                    if (filter.accepts(target.infos[block->triangle[i]], hits.back_faces >> i & 1,
                                       hits.u[i], hits.v[i]))
                        return true;
                }
            }
            return false;
        });
}

template <class View>
HWY_ATTR void visit(const Target& target, const math::Ray& ray, Visitor& visitor) {
    if (target.bounds.empty()) return;
    const RayLanes lanes(target.bounds, ray);
    if (!fits_float(hn::GetLane(lanes.largest), hn::GetLane(lanes.reach))) [[unlikely]]
        return visit_in_double(target, ray, visitor);
    const NodeRay node_ray(lanes);
    const BlockRay block_ray(lanes, ray);
    const geometry::ShearedRay sheared = geometry::shear(ray);
    float t_max = block_ray.t_max;
    const View view(target);
    LeafRoom room;
    visitor.counters.nodes += visit_from_near(
        view, node_ray, ray.t_min, t_max, [&](Link link) HWY_ATTR __attribute__((always_inline)) {
            constexpr uint32_t kWidth = accel::bvh::kBlockWidth;
            const Leaf leaf = view.leaf(link, room);
            visitor.counters.triangles += leaf.count;
            const Block* block = leaf.blocks;
            for (uint32_t first = 0; first < leaf.count; first += kWidth, ++block) {
                BlockHits hits;
                if (!intersect(block_ray, *block, t_max, hits)) continue;
                // Without what repeats the last triangle.
                const uint32_t filled = (1u << std::min(leaf.count - first, kWidth)) - 1;
                for (uint32_t hit = hits.lanes & filled; hit; hit &= hit - 1) {
                    const uint32_t i = uint32_t(std::countr_zero(hit));
                    if (hits.t[i] > t_max || !is_wanted(visitor, sheared, *block, i)) continue;
                    const bool back_face = hits.back_faces >> i & 1;
                    t_max =
                        std::min(t_max, visitor.see(block->triangle[i],
                                                    {hits.t[i], hits.u[i], hits.v[i], back_face}));
                }
            }
        });
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
