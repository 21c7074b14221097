// What beams are traced for: closest hits, or whether there is one. Included once for each
// instruction set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_KERNELS_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_KERNELS_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_KERNELS_INL_H
#endif

#include <hwy/highway.h>

#include "geometry/intersect.h"
#include "trace/bvh/beam/children-inl.h"
#include "trace/bvh/beam/judge-inl.h"
#include "trace/bvh/beam/occluded-inl.h"
#include "trace/bvh/beam/tiny_leaf-inl.h"
#include "trace/bvh/beam/traversal-inl.h"
#include "trace/bvh/stream/hit_board-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Judges a group's candidates: kernel.take(at, hits, dz, index) hears of those of eight rays up to
// kernel.end(at), kernel.test_one(block, lane, at) is asked for those whose main axis is another;
// `at` counts from the beam's first ray. Returns whether the kernel changed a limit.
template <bool Inside, class Kernel>
HWY_INLINE HWY_ATTR bool judge_group(const Beam& beam, const RayStream& rays,
                                     const BeamFacets& facets, const Block& block, uint32_t lane,
                                     uint32_t group, uint32_t candidates, Kernel& kernel) {
    const Judge facet(facets.vertex, lane);
    uint32_t alone = candidates & beam.foreign[group];
    candidates &= ~alone;
    bool changed = false;
    for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
        const uint32_t piece = candidates >> i & ((1u << kLanes8) - 1);
        if (piece == 0) continue;
        const uint32_t at = group * kGroupRays + i;
        const V8 dz = hn::LoadU(k8, rays.direction[beam.kz] + beam.first + at);
        const V8 begin = hn::LoadU(k8, rays.t_min + beam.first + at);
        const EightHits hits =
            judge<Inside>(facet, hn::Load(k8, beam.sx + at), hn::Load(k8, beam.sy + at), dz,
                          mask_of(piece), begin, kernel.end(at));
        if (!hn::AllFalse(k8, hits.lanes))
            changed |= kernel.take(at, hits, dz, block.triangle[lane]);
    }
    for (; alone; alone &= alone - 1)
        changed |=
            kernel.test_one(block, lane, group * kGroupRays + uint32_t(__builtin_ctz(alone)));
    return changed;
}

template <bool Filtered>
class ClosestBeam {
public:
    // Leaves up to this part of a beam's side are tiny; a group's is a quarter.
    static constexpr float kTinySide = 0.125f;
    // So many groups that meet a facet's window are not asked about its edges as wholes.
    static constexpr uint32_t kFewGroups = 0;
    static constexpr bool kLooksForRays = false;

    HWY_ATTR ClosestBeam(const Target& target, Beam& beam, const RayStream& rays,
                         const Filter& filter, const HitStream& out)
        : target_(target), beam_(beam), rays_(rays), filter_(filter),
          board_(rays, out, beam.first, beam.count) {}

    static uint32_t most_tiny() { return ~0u; }
    static uint32_t most_nodes() { return ~0u; }

    HWY_ATTR void trace() { board_.finish(visit_beam(target_, beam_, *this)); }

    HWY_INLINE HWY_ATTR void judge(const BeamFacets& facets, const Block& block, uint32_t lane,
                                   uint32_t group, const Candidates& rays) {
        const bool changed =
            rays.inside
                ? judge_group<true>(beam_, rays_, facets, block, lane, group, rays.open, *this)
                : judge_group<false>(beam_, rays_, facets, block, lane, group, rays.open, *this);
        if (changed) beam_.update_limit(group);
    }

    HWY_INLINE HWY_ATTR V8 end(uint32_t at) const { return board_.best(at); }

    HWY_INLINE HWY_ATTR bool take(uint32_t at, const EightHits& hits, V8 dz, uint32_t index) {
        const V8u keys = keys_of(index, hits);
        M8 wins = board_.find_wins(at, hits, keys);
        if (Filtered) wins = accepted(wins, filter_, target_.infos[index], hits);
        if (hn::AllFalse(k8, wins)) return false;
        board_.record(at, wins, hits, keys);
        const V8 z = hn::Mul(hits.t, hn::Mul(dz, hn::Set(k8, beam_.sign)));
        HitBoard::replace(wins, z, beam_.limit + at);
        return true;
    }

    HWY_INLINE HWY_ATTR bool test_one(const Block& block, uint32_t lane, uint32_t at) {
        const uint32_t index = block.triangle[lane];
        geometry::TriangleHit hit;
        if (!intersect_one(rays_, beam_.first + at, board_.t(at), block, lane, hit)
            || !board_.comes_first(at, hit, index)
            || (Filtered && !filter_.accepts(target_.infos[index], hit.back_face, hit.u, hit.v)))
            return false;
        board_.record_one(at, hit, index);
        beam_.limit[at] = hit.t * (beam_.sign * rays_.direction[beam_.kz][beam_.first + at]);
        return true;
    }

private:
    const Target& target_;
    Beam& beam_;
    const RayStream& rays_;
    const Filter& filter_;
    HitBoard board_;
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
