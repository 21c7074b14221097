// A beam through the wide BVH. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_TRAVERSAL_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_TRAVERSAL_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_TRAVERSAL_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/beam-inl.h"
#include "trace/bvh/facet-inl.h"
#include "trace/intersect_packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using accel::bvh::Link;
using accel::bvh::Node;
using trace::HWY_NAMESPACE::PacketHit;

struct BeamEntry {
    Link link;
    uint32_t groups;
    float z;
};

// The children of a node that a window's rays may enter.
struct BeamChildren {
    uint32_t entered;                  // bits
    uint32_t narrow;                   // bits: those that groups should be asked about one by one
    alignas(32) float near[8], far[8]; // z, cut to the beam's
    alignas(32) float x0[8], x1[8], y0[8], y1[8];

    HWY_INLINE HWY_ATTR void find(const Beam& beam, const Node& node, const Window& window,
                                  float limit);
    // The groups of `mask` whose rays may enter a child.
    HWY_INLINE HWY_ATTR uint32_t find_groups(const Beam& beam, uint32_t child, uint32_t mask) const;
};

HWY_INLINE HWY_ATTR void BeamChildren::find(const Beam& beam, const Node& node,
                                            const Window& window, float limit) {
    entered = narrow = 0;
    const bool ahead = beam.sign > 0;
    const float* z_first = ahead ? node.lower[beam.kz] : node.upper[beam.kz];
    const float* z_last = ahead ? node.upper[beam.kz] : node.lower[beam.kz];
    const V8 sign = hn::Set(k8, beam.sign);
    const V8 oz = hn::Set(k8, beam.sign * beam.origin[2]);
    const V8 margin = hn::Set(k8, beam.margin);
    const V8 ox = hn::Set(k8, beam.origin[0]), oy = hn::Set(k8, beam.origin[1]);
    const V8 p0 = hn::Set(k8, window.p0 + beam.center_p),
             p1 = hn::Set(k8, window.p1 + beam.center_p);
    const V8 q0 = hn::Set(k8, window.q0 + beam.center_q),
             q1 = hn::Set(k8, window.q1 + beam.center_q);
    const V8 wide_p = hn::Mul(hn::Set(k8, 0.5f), hn::Sub(p1, p0));
    const V8 wide_q = hn::Mul(hn::Set(k8, 0.5f), hn::Sub(q1, q0));
    for (size_t i = 0; i < accel::bvh::kWidth; i += kLanes8) {
        const V8 za = hn::Sub(hn::Mul(hn::Load(k8, z_first + i), sign), hn::Add(oz, margin));
        const V8 zb = hn::Sub(hn::Mul(hn::Load(k8, z_last + i), sign), hn::Sub(oz, margin));
        const V8 begin = hn::Max(za, hn::Set(k8, beam.near));
        const V8 end = hn::Min(zb, hn::Set(k8, limit));
        const V8 left = hn::Sub(hn::Sub(hn::Load(k8, node.lower[beam.kx] + i), ox), margin);
        const V8 right = hn::Add(hn::Sub(hn::Load(k8, node.upper[beam.kx] + i), ox), margin);
        const V8 bottom = hn::Sub(hn::Sub(hn::Load(k8, node.lower[beam.ky] + i), oy), margin);
        const V8 top = hn::Add(hn::Sub(hn::Load(k8, node.upper[beam.ky] + i), oy), margin);
        // Of the wedge between two slopes, the box must reach beyond neither side.
        const auto in_p = hn::And(hn::Ge(right, hn::Min(hn::Mul(p0, begin), hn::Mul(p0, end))),
                                  hn::Le(left, hn::Max(hn::Mul(p1, begin), hn::Mul(p1, end))));
        const auto in_q = hn::And(hn::Ge(top, hn::Min(hn::Mul(q0, begin), hn::Mul(q0, end))),
                                  hn::Le(bottom, hn::Max(hn::Mul(q1, begin), hn::Mul(q1, end))));
        const auto in = hn::And(hn::Le(begin, end), hn::And(in_p, in_q));
        entered |= bits_of(k8, in) << i;
        const auto small = hn::Or(hn::Lt(hn::Sub(right, left), hn::Mul(wide_p, begin)),
                                  hn::Lt(hn::Sub(top, bottom), hn::Mul(wide_q, begin)));
        narrow |= bits_of(k8, small) << i;
        hn::Store(begin, k8, near + i);
        hn::Store(end, k8, far + i);
        hn::Store(left, k8, x0 + i);
        hn::Store(right, k8, x1 + i);
        hn::Store(bottom, k8, y0 + i);
        hn::Store(top, k8, y1 + i);
    }
}

HWY_INLINE HWY_ATTR uint32_t BeamChildren::find_groups(const Beam& beam, uint32_t child,
                                                       uint32_t mask) const {
    const V8 begin = hn::Set(k8, near[child]), end = hn::Set(k8, far[child]);
    const V8 left = hn::Set(k8, x0[child]), right = hn::Set(k8, x1[child]);
    const V8 bottom = hn::Set(k8, y0[child]), top = hn::Set(k8, y1[child]);
    const V8 cp = hn::Set(k8, beam.center_p), cq = hn::Set(k8, beam.center_q);
    uint32_t bits = 0;
    for (uint32_t g = 0; g < kGroups; g += kLanes8) {
        const V8 p0 = hn::Add(hn::Load(k8, beam.group_p0 + g), cp);
        const V8 p1 = hn::Add(hn::Load(k8, beam.group_p1 + g), cp);
        const V8 q0 = hn::Add(hn::Load(k8, beam.group_q0 + g), cq);
        const V8 q1 = hn::Add(hn::Load(k8, beam.group_q1 + g), cq);
        const auto in_p = hn::And(hn::Ge(right, hn::Min(hn::Mul(p0, begin), hn::Mul(p0, end))),
                                  hn::Le(left, hn::Max(hn::Mul(p1, begin), hn::Mul(p1, end))));
        const auto in_q = hn::And(hn::Ge(top, hn::Min(hn::Mul(q0, begin), hn::Mul(q0, end))),
                                  hn::Le(bottom, hn::Max(hn::Mul(q1, begin), hn::Mul(q1, end))));
        const auto open = hn::Ge(hn::Load(k8, beam.group_limit + g), begin);
        bits |= bits_of(k8, hn::And(open, hn::And(in_p, in_q))) << g;
    }
    return bits & mask;
}

// Rays of a group that the facet's edge functions or window do not rule out, of those whose limit
// it does not exceed.
HWY_INLINE HWY_ATTR uint32_t find_rays(const Beam& beam, const Facets& facets, uint32_t lane,
                                       uint32_t group) {
    uint32_t rays = 0;
    const V8 nearest = hn::Set(k8, facets.nearest[lane]);
    const bool by_window = facets.by_window >> lane & 1;
    for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
        const uint32_t at = group * kGroupRays + i;
        const V8 p = hn::Load(k8, beam.from_center_p + at);
        const V8 q = hn::Load(k8, beam.from_center_q + at);
        const auto open = hn::Ge(hn::Load(k8, beam.limit + at), nearest);
        M8 in;
        if (by_window) {
            in = hn::And(hn::And(hn::Ge(p, hn::Set(k8, facets.p0[lane])),
                                 hn::Le(p, hn::Set(k8, facets.p1[lane]))),
                         hn::And(hn::Ge(q, hn::Set(k8, facets.q0[lane])),
                                 hn::Le(q, hn::Set(k8, facets.q1[lane]))));
        } else {
            const auto edge = [&](int k) HWY_ATTR {
                return hn::MulAdd(
                    p, hn::Set(k8, facets.a[k][lane]),
                    hn::MulAdd(q, hn::Set(k8, facets.b[k][lane]), hn::Set(k8, facets.c[k][lane])));
            };
            in = hn::Ge(hn::Min(edge(0), hn::Min(edge(1), edge(2))),
                        hn::Set(k8, -facets.tolerance[lane]));
        }
        rays |= bits_of(k8, hn::And(in, open)) << i;
    }
    return rays;
}

// The groups of `mask` with rays that may hit the facet.
HWY_INLINE HWY_ATTR uint32_t find_groups(const Beam& beam, const Facets& facets, uint32_t lane,
                                         uint32_t mask) {
    uint32_t groups = 0;
    const V8 nearest = hn::Set(k8, facets.nearest[lane]);
    if (facets.by_window >> lane & 1) {
        const V8 p0 = hn::Set(k8, facets.p0[lane]), p1 = hn::Set(k8, facets.p1[lane]);
        const V8 q0 = hn::Set(k8, facets.q0[lane]), q1 = hn::Set(k8, facets.q1[lane]);
        for (uint32_t g = 0; g < kGroups; g += kLanes8) {
            const auto in_p = hn::And(hn::Le(p0, hn::Load(k8, beam.group_p1 + g)),
                                      hn::Ge(p1, hn::Load(k8, beam.group_p0 + g)));
            const auto in_q = hn::And(hn::Le(q0, hn::Load(k8, beam.group_q1 + g)),
                                      hn::Ge(q1, hn::Load(k8, beam.group_q0 + g)));
            const auto open = hn::Ge(hn::Load(k8, beam.group_limit + g), nearest);
            groups |= bits_of(k8, hn::And(open, hn::And(in_p, in_q))) << g;
        }
        return groups & mask;
    }
    // The corner of a group's window where an edge function is largest depends on its signs alone.
    const float* p[3];
    const float* q[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = facets.a[k][lane] < 0 ? beam.group_p0 : beam.group_p1;
        q[k] = facets.b[k][lane] < 0 ? beam.group_q0 : beam.group_q1;
    }
    for (uint32_t g = 0; g < kGroups; g += kLanes8) {
        const auto edge = [&](int k) HWY_ATTR {
            return hn::MulAdd(hn::Load(k8, p[k] + g), hn::Set(k8, facets.a[k][lane]),
                              hn::MulAdd(hn::Load(k8, q[k] + g), hn::Set(k8, facets.b[k][lane]),
                                         hn::Set(k8, facets.c[k][lane])));
        };
        const auto in = hn::Ge(hn::Min(edge(0), hn::Min(edge(1), edge(2))),
                               hn::Set(k8, -facets.tolerance[lane]));
        const auto open = hn::Ge(hn::Load(k8, beam.group_limit + g), nearest);
        groups |= bits_of(k8, hn::And(in, open)) << g;
    }
    return groups & mask;
}

template <class Test>
HWY_INLINE HWY_ATTR void visit_leaf(const Target& target, const Beam& beam, Link leaf,
                                    uint32_t groups, const Window& window, float limit,
                                    Test&& test) {
    const uint32_t count = leaf.count();
    const Block* block = target.bvh_blocks + leaf.first_block();
    for (uint32_t first = 0; first < count; first += accel::bvh::kBlockWidth, ++block) {
        Facets facets;
        uint32_t lanes = facets.project(beam, *block, window, limit);
        if (count - first < accel::bvh::kBlockWidth) lanes &= (1u << (count - first)) - 1;
        for (; lanes; lanes &= lanes - 1) {
            const uint32_t lane = uint32_t(__builtin_ctz(lanes));
            for (uint32_t left = find_groups(beam, facets, lane, groups); left; left &= left - 1) {
                const uint32_t group = uint32_t(__builtin_ctz(left));
                const uint32_t rays = find_rays(beam, facets, lane, group);
                if (rays) test(facets, *block, lane, group, rays);
            }
        }
    }
}

// Goes through the blocks that the beam may hit, roughly from near to far. `test(facets, block,
// lane, group, rays)` decides for the rays, bits of a group, that the facet may be hit by. Returns
// the number of nodes visited.
template <class Test>
HWY_ATTR uint32_t visit_beam(const Target& target, Beam& beam, Test&& test) {
    BeamEntry stack[accel::bvh::kStackSize];
    uint32_t depth = 0;
    uint32_t visited = 0;
    stack[depth++] = {Link::inner(0), beam.groups, 0};
    Window window = beam.window;
    uint32_t window_groups = beam.groups;
    while (depth > 0) {
        const BeamEntry entry = stack[--depth];
        const uint32_t groups = beam.reaching(entry.groups, entry.z);
        if (groups == 0) continue;
        if (groups != window_groups) {
            window = groups == beam.groups ? beam.window : beam.window_of(groups);
            window_groups = groups;
        }
        const float limit = beam.limit_of(groups);
        if (entry.link.is_leaf()) {
            visit_leaf(target, beam, entry.link, groups, window, limit, test);
            continue;
        }
        ++visited;
        const Node& node = target.bvh_nodes[entry.link.node()];
        BeamChildren children;
        children.find(beam, node, window, limit);
        const uint32_t bottom = depth;
        for (uint32_t bits = children.entered; bits; bits &= bits - 1) {
            const uint32_t child = uint32_t(__builtin_ctz(bits));
            uint32_t mask = groups;
            if (children.narrow >> child & 1) {
                mask = children.find_groups(beam, child, groups);
                if (mask == 0) continue;
            }
            uint32_t place = depth++;
            for (; place > bottom && stack[place - 1].z < children.near[child]; --place)
                stack[place] = stack[place - 1];
            stack[place] = {node.child[child], mask, children.near[child]};
        }
    }
    return visited;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
