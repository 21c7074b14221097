// One ray through the wide BVH: eight boxes at a time, then four triangles at a time. Included once
// for each instruction set by simd_kernels.cpp.
#if defined(PEREGRINE_TRACE_BVH_SINGLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_SINGLE_INL_H
#undef PEREGRINE_TRACE_BVH_SINGLE_INL_H
#else
#define PEREGRINE_TRACE_BVH_SINGLE_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/block-inl.h"
#include "trace/bvh/plain.h"
#include "trace/bvh/push-inl.h"
#include "trace/kernels.h"
#include "trace/slabs.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

// The planes of a box, times `inverse`, plus these give where the ray enters and leaves it, widened
// by the margin of trace/slabs.h. Multiplied out, b / d - o / d may be off by the rounding of o /
// d, 3 e |o / d| with the sums, in addition to what slabs.h counts; 4 e |o / d| are added for it.
struct NodeRay {
    V8 inverse[3];
    V8 enter[3], leave[3];
    uint32_t enter_plane[3], leave_plane[3]; // offsets in a node, in floats
    uint32_t octant;

    HWY_ATTR explicit NodeRay(const Slabs<float>& slabs) {
        octant = 0;
        for (uint32_t k = 0; k < 3; ++k) {
            const float inverse_k = slabs.inverse[k];
            const float offset = slabs.origin[k] * inverse_k;
            const float margin = slabs.margin[k] + 0x1p-22f * std::fabs(offset);
            inverse[k] = hn::Set(k8, inverse_k);
            enter[k] = hn::Set(k8, -offset - margin);
            leave[k] = hn::Set(k8, margin - offset);
            const uint32_t negative = inverse_k < 0;
            octant |= negative << k;
            enter_plane[k] = (k + 3 * negative) * accel::bvh::kWidth;
            leave_plane[k] = (k + 3 * (1 - negative)) * accel::bvh::kWidth;
        }
    }
};

// Goes through the nodes that the ray may touch up to t_limit, roughly from near to far.
// `leaf(link)` may lower t_limit; it returns true to stop. Returns the number of nodes visited.
template <class Leaf>
HWY_INLINE HWY_ATTR uint32_t visit_leaves(const Node* nodes, const NodeRay& ray, float t_min,
                                          const float& t_limit, Leaf&& leaf) {
    Stack stack;
    uint32_t visited = 0;
    uint32_t index = 0;
    const V8 begin = hn::Set(k8, t_min);
    for (;;) {
        const Node& node = nodes[index];
        const float* planes = &node.lower[0][0];
        ++visited;
        const V8 end = hn::Set(k8, t_limit);
        Children children(node, ray.octant);
        for (size_t first = 0; first < accel::bvh::kWidth; first += kLanes8) {
            const auto enter = [&](uint32_t k) HWY_ATTR {
                return hn::MulAdd(hn::Load(k8, planes + ray.enter_plane[k] + first), ray.inverse[k],
                                  ray.enter[k]);
            };
            const auto leave = [&](uint32_t k) HWY_ATTR {
                return hn::MulAdd(hn::Load(k8, planes + ray.leave_plane[k] + first), ray.inverse[k],
                                  ray.leave[k]);
            };
            const V8 t_near = hn::Max(hn::Max(enter(0), enter(1)), hn::Max(enter(2), begin));
            const V8 t_far = hn::Min(hn::Min(leave(0), leave(1)), hn::Min(leave(2), end));
            children.set(first, hn::Le(t_near, t_far), t_near);
        }
        children.push(stack);
        for (;;) {
            if (stack.depth == 0) return visited;
            --stack.depth;
            if (stack.t_near[stack.depth] > t_limit) continue;
            const Link link{stack.link[stack.depth]};
            if (!link.is_leaf()) {
                index = link.node();
                break;
            }
            if (leaf(link)) return visited;
        }
    }
}

template <bool Filtered>
HWY_ATTR Hit closest(const Target& target, const math::Ray& ray, const Filter& filter) {
    const float distance = reach<float>(target.bounds, ray.origin);
    if (!fits_float(largest_component(ray.direction), distance)) [[unlikely]]
        return closest_plain<Filtered, double>(target, ray, filter);
    const Slabs<float> slabs = trace::slabs(target.bounds, ray, distance);
    if (!(slabs.t_near <= slabs.t_far)) return miss(0);
    const NodeRay node_ray(slabs);
    const BlockRay block_ray(ray);
    float t_limit = slabs.t_far;   // of what is of interest to nodes, ...
    float t_max = block_ray.t_max; // ... and to triangles
    Hit best = miss(0);
    const uint32_t steps =
        visit_leaves(target.bvh_nodes, node_ray, slabs.t_near, t_limit, [&](Link link) HWY_ATTR __attribute__((always_inline)) {
            const Block* block = target.bvh_blocks + link.first_block();
            const Block* last = block + (link.count() - 1) / accel::bvh::kBlockWidth;
            for (; block <= last; ++block) {
                BlockHits hits;
                if (!intersect(block_ray, *block, t_max, hits)) continue;
                for (uint32_t lanes = hits.lanes; lanes; lanes &= lanes - 1) {
                    const uint32_t i = uint32_t(__builtin_ctz(lanes));
                    const uint32_t index = block->triangle[i];
                    if (!comes_first(hits.t[i], index, t_max, best.triangle)) continue;
                    const bool back_face = hits.back_faces >> i & 1;
                    if (Filtered
                        && !filter.accepts(target.infos[index], back_face, hits.u[i], hits.v[i]))
                        continue;
                    best = {hits.t[i], hits.u[i], hits.v[i], index, back_face, 0};
                    t_max = hits.t[i];
                    t_limit = std::min(t_limit, t_max);
                }
            }
            return false;
        });
    best.steps = steps;
    return best;
}

template <bool Filtered>
HWY_ATTR bool occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
    const float distance = reach<float>(target.bounds, ray.origin);
    if (!fits_float(largest_component(ray.direction), distance)) [[unlikely]]
        return occluded_plain<Filtered, double>(target, ray, filter);
    const Slabs<float> slabs = trace::slabs(target.bounds, ray, distance);
    if (!(slabs.t_near <= slabs.t_far)) return false;
    const NodeRay node_ray(slabs);
    const BlockRay block_ray(ray);
    bool occluded = false;
    visit_leaves(target.bvh_nodes, node_ray, slabs.t_near, slabs.t_far, [&](Link link) HWY_ATTR __attribute__((always_inline)) {
        const Block* block = target.bvh_blocks + link.first_block();
        const Block* last = block + (link.count() - 1) / accel::bvh::kBlockWidth;
        for (; block <= last; ++block) {
            BlockHits hits;
            if (!intersect(block_ray, *block, block_ray.t_max, hits)) continue;
            if (!Filtered) return occluded = true;
            for (uint32_t lanes = hits.lanes; lanes; lanes &= lanes - 1) {
                const uint32_t i = uint32_t(__builtin_ctz(lanes));
                if (filter.accepts(target.infos[block->triangle[i]], hits.back_faces >> i & 1,
                                   hits.u[i], hits.v[i]))
                    return occluded = true;
            }
        }
        return false;
    });
    return occluded;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
