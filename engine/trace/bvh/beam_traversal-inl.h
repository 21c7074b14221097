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
#include "trace/bvh/tiny_leaf-inl.h"
#include "trace/eight_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace trace::HWY_NAMESPACE;

using accel::bvh::Link;
using accel::bvh::Node;

struct BeamEntry {
    Link link;
    uint32_t groups;
    float z;
    bool tiny; // a leaf that few rays can hit
};

// The children of a node that a window's rays may enter.
struct BeamChildren {
    uint32_t entered;                  // bits
    uint32_t narrow;                   // bits: those that groups should be asked about one by one
    uint32_t tiny;                     // bits: those that few rays enter, to be asked one by one
    alignas(32) float near[8], far[8]; // z, cut to the beam's
    alignas(32) float x0[8], x1[8], y0[8], y1[8];

    HWY_INLINE HWY_ATTR void find(const Beam& beam, const Node& node, const Window& window,
                                  float limit);
    // Slopes through a child that lies ahead as a whole.
    HWY_INLINE HWY_ATTR Window window_of(uint32_t child) const {
        const float near_inverse = 1 / near[child], far_inverse = 1 / far[child];
        const float slack = 1.0f + 0x1p-21f;
        return {std::min(x0[child] * near_inverse * slack, x0[child] * far_inverse),
                std::max(x1[child] * near_inverse * slack, x1[child] * far_inverse),
                std::min(y0[child] * near_inverse * slack, y0[child] * far_inverse),
                std::max(y1[child] * near_inverse * slack, y1[child] * far_inverse)};
    }
    // The groups of `mask` whose rays may enter a child.
    HWY_INLINE HWY_ATTR uint32_t find_groups(const Beam& beam, uint32_t child, uint32_t mask) const;
};

HWY_INLINE HWY_ATTR void BeamChildren::find(const Beam& beam, const Node& node,
                                            const Window& window, float limit) {
    entered = narrow = tiny = 0;
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
    // A quarter of the side of a beam is the side of a group.
    const V8 tiny_p = hn::Set(k8, 0.125f * (beam.window.p1 - beam.window.p0));
    const V8 tiny_q = hn::Set(k8, 0.125f * (beam.window.q1 - beam.window.q0));
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
        const auto few = hn::And(hn::Lt(hn::Sub(right, left), hn::Mul(tiny_p, begin)),
                                 hn::Lt(hn::Sub(top, bottom), hn::Mul(tiny_q, begin)));
        tiny |= bits_of(k8, few) << i;
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

// Rays of a group, as bits.
struct Candidates {
    uint32_t open = 0;    // may hit
    uint32_t certain = 0; // of these, those that do hit, within their limits
    bool inside = false;  // all open ones are between the edges for sure
};

// What a facet's window tells.
HWY_INLINE HWY_ATTR Candidates find_by_window(const Beam& beam, const Facets& facets, uint32_t lane,
                                              uint32_t group) {
    Candidates found;
    for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
        const uint32_t at = group * kGroupRays + i;
        const V8 p = hn::Load(k8, beam.p + at), q = hn::Load(k8, beam.q + at);
        const auto in_p = hn::And(hn::Ge(p, hn::Set(k8, facets.p0[lane])),
                                  hn::Le(p, hn::Set(k8, facets.p1[lane])));
        const auto in_q = hn::And(hn::Ge(q, hn::Set(k8, facets.q0[lane])),
                                  hn::Le(q, hn::Set(k8, facets.q1[lane])));
        const auto open = hn::Ge(hn::Load(k8, beam.limit + at), hn::Set(k8, facets.nearest[lane]));
        found.open |= bits_of(k8, hn::And(open, hn::And(in_p, in_q))) << i;
    }
    return found;
}

// What its edge functions and depth tell.
template <bool Inside>
HWY_INLINE HWY_ATTR Candidates find_by_edges(const Beam& beam, const Facets& facets, uint32_t lane,
                                             uint32_t group) {
    const V8 nearest = hn::Set(k8, facets.nearest[lane]);
    const V8 tolerance = hn::Set(k8, facets.tolerance[lane]);
    const V8 tolerance4 = hn::Mul(tolerance, hn::Set(k8, 4.0f));
    const V8 beyond_tolerance = hn::Set(k8, facets.beyond_tolerance[lane]);
    const bool ahead = facets.nearest[lane] >= beam.last_begin;
    Candidates found;
    for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
        const uint32_t at = group * kGroupRays + i;
        const V8 p = hn::Load(k8, beam.p + at), q = hn::Load(k8, beam.q + at);
        const auto linear = [&](const float* a, const float* b, const float* c) HWY_ATTR {
            return hn::MulAdd(p, hn::Set(k8, a[lane]),
                              hn::MulAdd(q, hn::Set(k8, b[lane]), hn::Set(k8, c[lane])));
        };
        const V8 limit = hn::Load(k8, beam.limit + at);
        M8 open = hn::Ge(limit, nearest);
        V8 least = hn::Zero(k8);
        if (!Inside) {
            least = hn::Min(linear(facets.a[0], facets.b[0], facets.c[0]),
                            hn::Min(linear(facets.a[1], facets.b[1], facets.c[1]),
                                    linear(facets.a[2], facets.b[2], facets.c[2])));
            open = hn::And(open, hn::Ge(least, hn::Neg(tolerance)));
        }
        if (hn::AllFalse(k8, open)) continue;
        const V8 det = linear(facets.det_a, facets.det_b, facets.det_c);
        const V8 beyond = linear(facets.beyond_a, facets.beyond_b, facets.beyond_c);
        // The limit is widened in `open` and narrowed in `certain` for its own rounding.
        const V8 further = hn::MulAdd(limit, hn::Set(k8, 1.0f + 0x1p-20f), hn::Neg(nearest));
        const V8 less_far = hn::MulSub(limit, hn::Set(k8, 1.0f - 0x1p-18f), nearest);
        open = hn::And(open, hn::Le(hn::Sub(beyond, beyond_tolerance),
                                    hn::Mul(further, hn::Add(det, tolerance4))));
        M8 certain =
            hn::Le(hn::Add(beyond, beyond_tolerance), hn::Mul(less_far, hn::Sub(det, tolerance4)));
        if (!Inside) certain = hn::And(certain, hn::Gt(least, tolerance));
        found.open |= bits_of(k8, open) << i;
        found.certain |= bits_of(k8, hn::And(certain, open)) << i;
    }
    if (!ahead) found.certain = 0;
    found.inside = Inside;
    return found;
}

HWY_INLINE HWY_ATTR Candidates find_candidates(const Beam& beam, const Facets& facets,
                                               uint32_t lane, uint32_t group, bool inside) {
    if (facets.by_window >> lane & 1) return find_by_window(beam, facets, lane, group);
    if (!inside) return find_by_edges<false>(beam, facets, lane, group);
    if (!(beam.endless >> group & 1)) return find_by_edges<true>(beam, facets, lane, group);
    const bool ahead = facets.nearest[lane] >= beam.last_begin;
    return {kAllRays, ahead ? kAllRays : 0, true};
}

// Groups, as bits.
struct GroupsOfFacet {
    uint32_t open = 0;   // have rays that may hit
    uint32_t inside = 0; // of these, those with all rays between the edges
};

HWY_INLINE HWY_ATTR GroupsOfFacet find_groups(const Beam& beam, const Facets& facets, uint32_t lane,
                                              uint32_t mask) {
    GroupsOfFacet groups;
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
            groups.open |= bits_of(k8, hn::And(open, hn::And(in_p, in_q))) << g;
        }
        groups.open &= mask;
        return groups;
    }
    // The corners of a group's window where an edge function is largest and smallest depend on its
    // signs alone.
    const float *high_p[3], *high_q[3], *low_p[3], *low_q[3];
    for (int k = 0; k < 3; ++k) {
        const bool left = facets.a[k][lane] < 0, top = facets.b[k][lane] < 0;
        high_p[k] = left ? beam.group_p0 : beam.group_p1;
        low_p[k] = left ? beam.group_p1 : beam.group_p0;
        high_q[k] = top ? beam.group_q0 : beam.group_q1;
        low_q[k] = top ? beam.group_q1 : beam.group_q0;
    }
    const V8 tolerance = hn::Set(k8, facets.tolerance[lane]);
    const V8 tolerance4 = hn::Mul(tolerance, hn::Set(k8, 4.0f));
    const V8 beyond_tolerance = hn::Set(k8, facets.beyond_tolerance[lane]);
    for (uint32_t g = 0; g < kGroups; g += kLanes8) {
        const auto edge = [&](const float* const* p, const float* const* q, int k) HWY_ATTR {
            return hn::MulAdd(hn::Load(k8, p[k] + g), hn::Set(k8, facets.a[k][lane]),
                              hn::MulAdd(hn::Load(k8, q[k] + g), hn::Set(k8, facets.b[k][lane]),
                                         hn::Set(k8, facets.c[k][lane])));
        };
        const V8 most = hn::Min(edge(high_p, high_q, 0),
                                hn::Min(edge(high_p, high_q, 1), edge(high_p, high_q, 2)));
        const V8 least =
            hn::Min(edge(low_p, low_q, 0), hn::Min(edge(low_p, low_q, 1), edge(low_p, low_q, 2)));
        // What find_by_edges asks of each ray: here of the corner where it comes closest to yes.
        const V8 limit = hn::Load(k8, beam.group_limit + g);
        const V8 further = hn::MulAdd(limit, hn::Set(k8, 1.0f + 0x1p-20f), hn::Neg(nearest));
        const auto excess = [&](const float* beyond, const float* det) HWY_ATTR {
            return hn::NegMulAdd(further, hn::Set(k8, det[lane]), hn::Set(k8, beyond[lane]));
        };
        const V8 ea = excess(facets.beyond_a, facets.det_a);
        const V8 eb = excess(facets.beyond_b, facets.det_b);
        const V8 ec = excess(facets.beyond_c, facets.det_c);
        const V8 least_excess =
            hn::Add(ec, hn::Add(hn::Min(hn::Mul(ea, hn::Load(k8, beam.group_p0 + g)),
                                        hn::Mul(ea, hn::Load(k8, beam.group_p1 + g))),
                                hn::Min(hn::Mul(eb, hn::Load(k8, beam.group_q0 + g)),
                                        hn::Mul(eb, hn::Load(k8, beam.group_q1 + g)))));
        const auto too_far =
            hn::Gt(least_excess, hn::MulAdd(further, tolerance4, beyond_tolerance));
        const auto open =
            hn::AndNot(too_far, hn::And(hn::Ge(limit, nearest), hn::Ge(most, hn::Neg(tolerance))));
        groups.open |= bits_of(k8, open) << g;
        groups.inside |= bits_of(k8, hn::Gt(least, tolerance)) << g;
    }
    groups.open &= mask;
    return groups;
}

template <class Kernel>
HWY_INLINE HWY_ATTR void visit_leaf(const Target& target, const Beam& beam, Link leaf,
                                    uint32_t mask, const Window& window, float limit,
                                    Kernel& kernel) {
    const uint32_t count = leaf.count();
    const Block* block = target.bvh_blocks + leaf.first_block();
    for (uint32_t first = 0; first < count; first += accel::bvh::kBlockWidth, ++block) {
        Facets facets;
        uint32_t lanes = facets.project(beam, *block, window, limit);
        if (count - first < accel::bvh::kBlockWidth) lanes &= (1u << (count - first)) - 1;
        for (; lanes; lanes &= lanes - 1) {
            const uint32_t lane = uint32_t(__builtin_ctz(lanes));
            const GroupsOfFacet groups = find_groups(beam, facets, lane, mask);
            for (uint32_t left = groups.open; left; left &= left - 1) {
                const uint32_t group = uint32_t(__builtin_ctz(left));
                const Candidates rays =
                    find_candidates(beam, facets, lane, group, groups.inside >> group & 1);
                if (rays.open) kernel.judge(facets, *block, lane, group, rays);
            }
        }
    }
}

// Goes through what the beam may hit, roughly from near to far. `kernel.judge(facets, block, lane,
// group, candidates)` decides for the rays of a group and a facet, `kernel.take(at, index, hit)`
// hears of the hit of a ray that was tested alone. Returns the number of nodes visited.
template <class Kernel>
HWY_ATTR uint32_t visit_beam(const Target& target, Beam& beam, Kernel& kernel) {
    BeamEntry stack[accel::bvh::kStackSize];
    Window windows[accel::bvh::kStackSize]; // of those entries that are tiny
    uint32_t depth = 0;
    uint32_t visited = 0;
    stack[depth++] = {Link::inner(0), beam.groups, 0, false};
    Window window = beam.window;
    uint32_t window_groups = beam.groups;
    while (depth > 0) {
        const BeamEntry entry = stack[--depth];
        const uint32_t groups = beam.reaching(entry.groups, entry.z);
        if (groups == 0) continue;
        if (entry.tiny) {
            visit_tiny_leaf(target, beam, entry.link, groups, entry.z, windows[depth], kernel);
            continue;
        }
        if (groups != window_groups) {
            window = groups == beam.groups ? beam.window : beam.window_of(groups);
            window_groups = groups;
        }
        const float limit = beam.limit_of(groups);
        if (entry.link.is_leaf()) {
            visit_leaf(target, beam, entry.link, groups, window, limit, kernel);
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
            const Link link = node.child[child];
            const bool tiny = link.is_leaf() && (children.tiny >> child & 1);
            uint32_t place = depth++;
            for (; place > bottom && stack[place - 1].z < children.near[child]; --place) {
                stack[place] = stack[place - 1];
                windows[place] = windows[place - 1];
            }
            stack[place] = {link, mask, children.near[child], tiny};
            if (tiny) windows[place] = children.window_of(child);
        }
    }
    return visited;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
