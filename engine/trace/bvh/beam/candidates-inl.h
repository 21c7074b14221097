// Which rays of a beam may hit a facet, as far as linear functions tell. Included once for each
// instruction set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_CANDIDATES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_CANDIDATES_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_CANDIDATES_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_CANDIDATES_INL_H
#endif

#include <hwy/highway.h>

#include "simd/lanes-inl.h"
#include "trace/bvh/beam/groups-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Rays of a group, as bits.
struct Candidates {
    uint32_t open = 0;    // may hit
    uint32_t certain = 0; // of these, those that do hit, within their limits
    bool inside = false;  // all open ones are between the edges for sure
};

// A facet's linear functions at eight rays or at corners of windows.
HWY_INLINE HWY_ATTR V8 linear_at(V8 p, V8 q, float a, float b, float c) {
    return hn::MulAdd(p, hn::Set(k8, a), hn::MulAdd(q, hn::Set(k8, b), hn::Set(k8, c)));
}

template <class Beam>
HWY_INLINE HWY_ATTR V8 height_at(const Beam&, V8 limit, V8 p, V8 q, const Facets& facets,
                                 uint32_t lane) {
    return Beam::height(limit, p, q, hn::Set(k8, facets.plane_a[lane]),
                        hn::Set(k8, facets.plane_b[lane]), hn::Set(k8, facets.plane_c[lane]));
}

// What a facet's window and plane tell.
template <class Beam>
HWY_INLINE HWY_ATTR Candidates find_by_window(const Beam& beam, const Facets& facets, uint32_t lane,
                                              uint32_t group) {
    Candidates found;
    for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
        const uint32_t at = group * kGroupRays + i;
        const V8 p = hn::Load(k8, beam.p + at), q = hn::Load(k8, beam.q + at);
        const V8 limit = hn::Load(k8, beam.limit + at);
        const auto in_p = hn::And(hn::Ge(p, hn::Set(k8, facets.p0[lane])),
                                  hn::Le(p, hn::Set(k8, facets.p1[lane])));
        const auto in_q = hn::And(hn::Ge(q, hn::Set(k8, facets.q0[lane])),
                                  hn::Le(q, hn::Set(k8, facets.q1[lane])));
        const V8 h = height_at(beam, limit, p, q, facets, lane);
        const auto beyond = hn::Lt(h, hn::Set(k8, facets.least_h[lane]));
        const auto open = hn::AndNot(beyond, hn::Ge(limit, hn::Set(k8, facets.nearest[lane])));
        found.open |= bits_of(k8, hn::And(open, hn::And(in_p, in_q))) << i;
    }
    return found;
}

// What its edge functions and plane tell: of all rays without a branch, since whether there are any
// left is hard to predict.
template <bool Inside, class Beam>
HWY_INLINE HWY_ATTR Candidates find_by_edges(const Beam& beam, const Facets& facets, uint32_t lane,
                                             uint32_t group) {
    const V8 nearest = hn::Set(k8, facets.nearest[lane]);
    const V8 tolerance = hn::Set(k8, facets.tolerance[lane]);
    const V8 least_h = hn::Set(k8, facets.least_h[lane]), most_h = hn::Set(k8, facets.most_h[lane]);
    Candidates found;
    found.inside = Inside;
    for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
        const uint32_t at = group * kGroupRays + i;
        const V8 p = hn::Load(k8, beam.p + at), q = hn::Load(k8, beam.q + at);
        const V8 limit = hn::Load(k8, beam.limit + at);
        const V8 h = height_at(beam, limit, p, q, facets, lane);
        M8 open = hn::AndNot(hn::Lt(h, least_h), hn::Ge(limit, nearest));
        M8 certain = hn::Gt(h, most_h);
        if (!Inside) {
            const auto edge = [&](int k) HWY_ATTR __attribute__((always_inline)) {
                return linear_at(p, q, facets.a[k][lane], facets.b[k][lane], facets.c[k][lane]);
            };
            const V8 least = hn::Min(edge(0), hn::Min(edge(1), edge(2)));
            open = hn::And(open, hn::Ge(least, hn::Neg(tolerance)));
            certain = hn::And(certain, hn::Gt(least, tolerance));
        }
        found.open |= bits_of(k8, open) << i;
        found.certain |= bits_of(k8, certain) << i;
    }
    found.certain = facets.nearest[lane] >= beam.last_begin ? found.certain & found.open : 0;
    return found;
}

template <class Beam>
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

// Groups of `mask` whose windows meet the facet's, and of which some end beyond its plane.
template <class Beam>
HWY_INLINE HWY_ATTR uint32_t find_meeting(const Beam& beam, const Facets& facets, uint32_t lane,
                                          uint32_t mask) {
    const V8 nearest = hn::Set(k8, facets.nearest[lane]);
    const V8 p0 = hn::Set(k8, facets.p0[lane]), p1 = hn::Set(k8, facets.p1[lane]);
    const V8 q0 = hn::Set(k8, facets.q0[lane]), q1 = hn::Set(k8, facets.q1[lane]);
    const bool plane_left = facets.plane_a[lane] < 0, plane_top = facets.plane_b[lane] < 0;
    const float* const plane_p = plane_left ? beam.group_p0 : beam.group_p1;
    const float* const plane_q = plane_top ? beam.group_q0 : beam.group_q1;
    uint32_t bits = 0;
    for (uint32_t g = 0; g < kGroups; g += kLanes8) {
        const auto in_p = hn::And(hn::Le(p0, hn::Load(k8, beam.group_p1 + g)),
                                  hn::Ge(p1, hn::Load(k8, beam.group_p0 + g)));
        const auto in_q = hn::And(hn::Le(q0, hn::Load(k8, beam.group_q1 + g)),
                                  hn::Ge(q1, hn::Load(k8, beam.group_q0 + g)));
        const V8 limit = hn::Load(k8, beam.group_limit + g);
        // What find_by_edges asks of each ray: here of the corner where it comes closest to yes.
        const V8 h = height_at(beam, limit, hn::Load(k8, plane_p + g), hn::Load(k8, plane_q + g),
                               facets, lane);
        const auto beyond = hn::Lt(h, hn::Set(k8, facets.least_h[lane]));
        const auto open = hn::AndNot(beyond, hn::Ge(limit, nearest));
        bits |= bits_of(k8, hn::And(open, hn::And(in_p, in_q))) << g;
    }
    return bits & mask;
}

// Groups of `mask`, which find_meeting returned, as far as edge functions tell.
template <class Beam>
HWY_INLINE HWY_ATTR GroupsOfFacet find_groups(const Beam& beam, const Facets& facets, uint32_t lane,
                                              uint32_t mask) {
    if (facets.by_window >> lane & 1) return {mask, 0};
    GroupsOfFacet groups;
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
    for (uint32_t g = 0; g < kGroups; g += kLanes8) {
        const auto edge = [&](const float* const* p, const float* const* q, int k) HWY_ATTR {
            return linear_at(hn::Load(k8, p[k] + g), hn::Load(k8, q[k] + g), facets.a[k][lane],
                             facets.b[k][lane], facets.c[k][lane]);
        };
        const V8 most = hn::Min(edge(high_p, high_q, 0),
                                hn::Min(edge(high_p, high_q, 1), edge(high_p, high_q, 2)));
        const V8 least =
            hn::Min(edge(low_p, low_q, 0), hn::Min(edge(low_p, low_q, 1), edge(low_p, low_q, 2)));
        groups.open |= bits_of(k8, hn::Ge(most, hn::Neg(tolerance))) << g;
        groups.inside |= bits_of(k8, hn::Gt(least, tolerance)) << g;
    }
    groups.open &= mask;
    return groups;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
