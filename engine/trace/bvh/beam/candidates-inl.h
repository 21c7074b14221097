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
#include "trace/bvh/beam/beam-inl.h"
#include "trace/bvh/beam/facet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

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
    const float* p = beam.p + group * kGroupRays;
    const float* q = beam.q + group * kGroupRays;
    const float* limits = beam.limit + group * kGroupRays;
    const auto linear = [&](uint32_t i, const float* a, const float* b, const float* c) HWY_ATTR
        __attribute__((always_inline)) {
        return hn::MulAdd(
            hn::Load(k8, p + i), hn::Set(k8, a[lane]),
            hn::MulAdd(hn::Load(k8, q + i), hn::Set(k8, b[lane]), hn::Set(k8, c[lane])));
    };
    // All rays before the first branch: whether there are any left is hard to predict.
    uint32_t left = 0;
    alignas(64) float least[kGroupRays];
    for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
        M8 open = hn::Ge(hn::Load(k8, limits + i), nearest);
        if (!Inside) {
            const V8 edge = hn::Min(linear(i, facets.a[0], facets.b[0], facets.c[0]),
                                    hn::Min(linear(i, facets.a[1], facets.b[1], facets.c[1]),
                                            linear(i, facets.a[2], facets.b[2], facets.c[2])));
            hn::Store(edge, k8, least + i);
            open = hn::And(open, hn::Ge(edge, hn::Neg(tolerance)));
        }
        left |= bits_of(k8, open) << i;
    }
    Candidates found;
    found.inside = Inside;
    if (left == 0) return found;
    const V8 tolerance4 = hn::Mul(tolerance, hn::Set(k8, 4.0f));
    const V8 beyond_tolerance = hn::Set(k8, facets.beyond_tolerance[lane]);
    const bool ahead = facets.nearest[lane] >= beam.last_begin;
    for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
        const uint32_t set = left >> i & ((1u << kLanes8) - 1);
        if (set == 0) continue;
        const V8 limit = hn::Load(k8, limits + i);
        const V8 det = linear(i, facets.det_a, facets.det_b, facets.det_c);
        const V8 beyond = linear(i, facets.beyond_a, facets.beyond_b, facets.beyond_c);
        // The limit is widened in `open` and narrowed in `certain` for its own rounding.
        const V8 further = hn::MulAdd(limit, hn::Set(k8, 1.0f + 0x1p-20f), hn::Neg(nearest));
        const V8 less_far = hn::MulSub(limit, hn::Set(k8, 1.0f - 0x1p-18f), nearest);
        const uint32_t open = set
                              & bits_of(k8, hn::Le(hn::Sub(beyond, beyond_tolerance),
                                                   hn::Mul(further, hn::Add(det, tolerance4))));
        M8 certain =
            hn::Le(hn::Add(beyond, beyond_tolerance), hn::Mul(less_far, hn::Sub(det, tolerance4)));
        if (!Inside) certain = hn::And(certain, hn::Gt(hn::Load(k8, least + i), tolerance));
        found.open |= open << i;
        found.certain |= (bits_of(k8, certain) & open) << i;
    }
    if (!ahead) found.certain = 0;
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

// Groups of `mask` whose windows meet the facet's.
HWY_INLINE HWY_ATTR uint32_t find_meeting(const Beam& beam, const Facets& facets, uint32_t lane,
                                          uint32_t mask) {
    const V8 nearest = hn::Set(k8, facets.nearest[lane]);
    const V8 p0 = hn::Set(k8, facets.p0[lane]), p1 = hn::Set(k8, facets.p1[lane]);
    const V8 q0 = hn::Set(k8, facets.q0[lane]), q1 = hn::Set(k8, facets.q1[lane]);
    uint32_t bits = 0;
    for (uint32_t g = 0; g < kGroups; g += kLanes8) {
        const auto in_p = hn::And(hn::Le(p0, hn::Load(k8, beam.group_p1 + g)),
                                  hn::Ge(p1, hn::Load(k8, beam.group_p0 + g)));
        const auto in_q = hn::And(hn::Le(q0, hn::Load(k8, beam.group_q1 + g)),
                                  hn::Ge(q1, hn::Load(k8, beam.group_q0 + g)));
        const auto open = hn::Ge(hn::Load(k8, beam.group_limit + g), nearest);
        bits |= bits_of(k8, hn::And(open, hn::And(in_p, in_q))) << g;
    }
    return bits & mask;
}

// Groups of `mask`, which find_meeting returned, as far as edge functions and depth tell.
HWY_INLINE HWY_ATTR GroupsOfFacet find_groups(const Beam& beam, const Facets& facets, uint32_t lane,
                                              uint32_t mask) {
    if (facets.by_window >> lane & 1) return {mask, 0};
    GroupsOfFacet groups;
    const V8 nearest = hn::Set(k8, facets.nearest[lane]);
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
        const auto open = hn::AndNot(too_far, hn::Ge(most, hn::Neg(tolerance)));
        groups.open |= bits_of(k8, open) << g;
        groups.inside |= bits_of(k8, hn::Gt(least, tolerance)) << g;
    }
    groups.open &= mask;
    return groups;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
