// What a beam of parallel rays does with the triangles that lines leave open. Included once for
// each instruction set.
#if defined(PEREGRINE_TRACE_BVH_PARALLEL_LEAF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_PARALLEL_LEAF_INL_H
#undef PEREGRINE_TRACE_BVH_PARALLEL_LEAF_INL_H
#else
#define PEREGRINE_TRACE_BVH_PARALLEL_LEAF_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/parallel/facet-inl.h"
#include "trace/bvh/parallel/parallel-inl.h"
#include "trace/bvh/tree/decode-inl.h"
#include "trace/eight_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;
using namespace trace::HWY_NAMESPACE;

using accel::bvh::Link;

// A triangle relative to eight rays: step 3 of geometry/intersect.h.
HWY_INLINE HWY_ATTR Sheared<V8> relative_to(const ParallelBeam& beam, const RayStream& rays,
                                            uint32_t at, const Block& block, uint32_t lane) {
    const uint32_t ray = beam.first + at;
    const V8 ox = hn::LoadU(k8, rays.origin[beam.kx] + ray);
    const V8 oy = hn::LoadU(k8, rays.origin[beam.ky] + ray);
    const V8 oz = hn::LoadU(k8, rays.origin[beam.kz] + ray);
    const V8 sx = hn::Set(k8, beam.sx), sy = hn::Set(k8, beam.sy);
    const auto corner = [&](int i, V8& x, V8& y, V8& z) HWY_ATTR __attribute__((always_inline)) {
        z = hn::Sub(hn::Set(k8, block.vertex[i][beam.kz][lane]), oz);
        x = shear(hn::Sub(hn::Set(k8, block.vertex[i][beam.kx][lane]), ox), sx, z);
        y = shear(hn::Sub(hn::Set(k8, block.vertex[i][beam.ky][lane]), oy), sy, z);
    };
    Sheared<V8> s;
    corner(0, s.ax, s.ay, s.az);
    corner(1, s.bx, s.by, s.bz);
    corner(2, s.cx, s.cy, s.cz);
    return s;
}

// The canonical test for a group's candidates, as of Beam.
template <bool Inside, class Kernel>
HWY_INLINE HWY_ATTR bool judge_group(const ParallelBeam& beam, const RayStream& rays,
                                     const ParallelFacets&, const Block& block, uint32_t lane,
                                     uint32_t group, uint32_t candidates, Kernel& kernel) {
    bool changed = false;
    for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
        const uint32_t piece = candidates >> i & ((1u << kLanes8) - 1);
        if (piece == 0) continue;
        const uint32_t at = group * kGroupRays + i;
        const Sheared<V8> s = relative_to(beam, rays, at, block, lane);
        const M8 maybe = hn::AndNot(outside(s), mask_of(piece));
        if (hn::AllFalse(k8, maybe)) continue;
        const V8 dz = hn::Set(k8, rays.direction[beam.kz][beam.first]);
        const V8 begin = hn::LoadU(k8, rays.t_min + beam.first + at);
        const EightHits hits = decide(s, dz, maybe, begin, kernel.end(at));
        if (!hn::AllFalse(k8, hits.lanes))
            changed |= kernel.take(at, hits, dz, block.triangle[lane]);
    }
    return changed;
}

// The lines of four facets, for one ray after the other.
struct FourFacets {
    V4 a[3], b[3], c[3], tolerance;
    V4 plane_a, plane_b, least_h, most_h, nearest;
    uint32_t seen, by_window, ahead; // bits

    HWY_INLINE HWY_ATTR FourFacets(const ParallelBeam& beam, const ParallelFacets& facets,
                                   uint32_t seen_ones)
        : seen(seen_ones), by_window(facets.by_window) {
        for (int k = 0; k < 3; ++k) {
            a[k] = hn::Load(k4, facets.a[k]);
            b[k] = hn::Load(k4, facets.b[k]);
            c[k] = hn::Load(k4, facets.c[k]);
        }
        tolerance = hn::Load(k4, facets.tolerance);
        plane_a = hn::Load(k4, facets.plane_a);
        plane_b = hn::Load(k4, facets.plane_b);
        least_h = hn::Load(k4, facets.least_h);
        most_h = hn::Load(k4, facets.most_h);
        nearest = hn::Load(k4, facets.nearest);
        ahead = bits_of(k4, hn::Ge(nearest, hn::Set(k4, beam.last_begin))) & ~by_window;
    }

    // find_by_edges, with triangles for rays.
    HWY_INLINE HWY_ATTR void find(float ray_p, float ray_q, float ray_limit, uint32_t& open,
                                  uint32_t& certain) const {
        const V4 p = hn::Set(k4, ray_p), q = hn::Set(k4, ray_q), limit = hn::Set(k4, ray_limit);
        const auto edge = [&](int k) HWY_ATTR __attribute__((always_inline)) {
            return hn::MulAdd(p, a[k], hn::MulAdd(q, b[k], c[k]));
        };
        const V4 least = hn::Min(edge(0), hn::Min(edge(1), edge(2)));
        const V4 h = hn::MulAdd(p, plane_a, hn::MulAdd(q, plane_b, limit));
        const uint32_t near_enough =
            bits_of(k4, hn::AndNot(hn::Lt(h, least_h), hn::Ge(limit, nearest)));
        open = (bits_of(k4, hn::Ge(least, hn::Neg(tolerance))) | by_window) & near_enough & seen;
        certain = bits_of(k4, hn::And(hn::Gt(least, tolerance), hn::Gt(h, most_h))) & ahead & open;
    }
};

// A leaf that few rays can hit: ray by ray, four triangles at a time.
template <class Kernel>
HWY_INLINE HWY_ATTR void visit_tiny_leaf(const Target& target, ParallelBeam& beam, Link link,
                                         uint32_t groups, float z, const Window& window,
                                         Kernel& kernel) {
    uint32_t found = 0;
    uint32_t rays[kGroups];
    for (uint32_t left = groups; left; left &= left - 1) {
        const uint32_t group = uint32_t(__builtin_ctz(left));
        rays[group] = beam.find_rays(group, window, z);
        found |= rays[group] ? 1u << group : 0;
    }
    if (found == 0) return;
    const float limit = beam.limit_of(found);
    LeafRoom room;
    const Leaf leaf = fetch_leaf(target, link, room);
    const Block* block = leaf.blocks;
    uint32_t changed = 0;
    for (uint32_t first = 0; first < leaf.count; first += accel::bvh::kBlockWidth, ++block) {
        ParallelFacets facets;
        uint32_t seen = facets.project(beam, *block, window, limit);
        if (leaf.count - first < accel::bvh::kBlockWidth) seen &= (1u << (leaf.count - first)) - 1;
        if (seen == 0) continue;
        const FourFacets four(beam, facets, seen);
        for (uint32_t left = found; left; left &= left - 1) {
            const uint32_t group = uint32_t(__builtin_ctz(left));
            for (uint32_t bits = rays[group]; bits; bits &= bits - 1) {
                const uint32_t at = group * kGroupRays + uint32_t(__builtin_ctz(bits));
                uint32_t open, certain;
                four.find(beam.p[at], beam.q[at], beam.limit[at], open, certain);
                if (open && kernel.test_some(*block, open, certain, at)) {
                    rays[group] &= ~(bits & -bits);
                    changed |= 1u << group;
                }
            }
        }
    }
    for (; changed; changed &= changed - 1) beam.update_limit(uint32_t(__builtin_ctz(changed)));
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
