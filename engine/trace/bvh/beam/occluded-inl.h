// Whether the rays of a Beam or a ParallelBeam hit anything. Included once for each instruction
// set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_OCCLUDED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_OCCLUDED_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_OCCLUDED_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_OCCLUDED_INL_H
#endif

#include <hwy/highway.h>

#include "geometry/intersect.h"
#include "trace/bvh/beam/traversal-inl.h"
#include "trace/bvh/single/plain.h"
#include "trace/eight_rays-inl.h"

#include <bit>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;
using namespace trace::HWY_NAMESPACE;

// The canonical test for one ray, with t up to `end`.
HWY_INLINE HWY_ATTR bool intersect_one(const RayStream& rays, uint32_t at, float end,
                                       const Block& block, uint32_t lane,
                                       geometry::TriangleHit& hit) {
    math::Ray ray = ray_at(rays, at);
    ray.t_max = end;
    return bvh::intersect(geometry::shear(ray), block, lane, hit);
}

// Whether rays that have nothing in common go in waves (wave/wave-inl.h), not one by one.
constexpr bool kWaves = HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3;

// B: Beam or ParallelBeam, for which there are visit_tiny_leaf and judge_group.
template <class B, bool Filtered>
class OccludedBeam {
    using Shadows = typename B::Shadows;

public:
    static constexpr float kTinySide = Shadows::kTinySide; // see ClosestBeam
    static constexpr uint32_t kFewGroups = 6;
    static constexpr bool kLooksForRays = Shadows::kLooksForRays;

    HWY_ATTR OccludedBeam(const Target& target, B& beam, const RayStream& rays,
                          const Filter& filter)
        : target_(target), beam_(beam), rays_(rays), filter_(filter) {}

    // Where rays are sparse, or triangles smaller than what lies between them, a wave is faster.
    uint32_t most_tiny() const { return kWaves ? Shadows::most_tiny(beam_.count) : ~0u; }
    uint32_t most_nodes() const { return kWaves ? Shadows::most_nodes(beam_.count) : ~0u; }

    // False: these rays had better not be a beam, and nothing is known of them.
    HWY_ATTR bool trace(uint8_t* occluded) {
        if (visit_beam(target_, beam_, *this) == kGaveUp) return false;
        report(occluded + beam_.first);
        return true;
    }

    HWY_INLINE HWY_ATTR void judge(const typename B::SeenFacets& facets, const Block& block,
                                   uint32_t lane, uint32_t group, const Candidates& rays) {
        uint32_t certain = rays.certain;
        if (Filtered && certain && !filter_.accepts_all(target_.infos[block.triangle[lane]]))
            certain = 0;
        for (uint32_t i = 0; certain && i < kGroupRays; i += kLanes8)
            block_lanes(group * kGroupRays + i, mask_of(certain >> i));
        blocked_[group] |= certain;
        const uint32_t open = rays.open & ~certain;
        const bool changed =
            open && judge_group<false>(beam_, rays_, facets, block, lane, group, open, *this);
        if (certain || changed) beam_.update_limit(group);
    }

    HWY_INLINE HWY_ATTR V8 end(uint32_t at) const {
        return hn::LoadU(k8, rays_.t_max + beam_.first + at);
    }

    HWY_INLINE HWY_ATTR bool take(uint32_t at, const EightHits& hits, V8, uint32_t index) {
        M8 hit = hits.lanes;
        if (Filtered) hit = accepted(hit, filter_, target_.infos[index], hits);
        if (hn::AllFalse(k8, hit)) return false;
        block_lanes(at, hit);
        blocked_[at / kGroupRays] |= bits_of(k8, hit) << at % kGroupRays;
        return true;
    }

    HWY_INLINE HWY_ATTR bool test_one(const Block& block, uint32_t lane, uint32_t at) {
        if (beam_.limit[at] == kNever) return false; // already
        geometry::TriangleHit hit;
        if (!intersect_one(rays_, beam_.first + at, rays_.t_max[beam_.first + at], block, lane, hit)
            || (Filtered
                && !filter_.accepts(target_.infos[block.triangle[lane]], hit.back_face, hit.u,
                                    hit.v)))
            return false;
        return block_one(at);
    }

    // Of one ray and a block: the triangles that it may hit, and those of them that it hits for
    // certain unless the filter objects.
    HWY_INLINE HWY_ATTR bool test_some(const Block& block, uint32_t open, uint32_t certain,
                                       uint32_t at) {
        for (; certain; certain &= certain - 1) {
            const uint32_t index = block.triangle[__builtin_ctz(certain)];
            if (!Filtered || filter_.accepts_all(target_.infos[index])) return block_one(at);
        }
        for (; open; open &= open - 1)
            if (test_one(block, uint32_t(__builtin_ctz(open)), at)) return true;
        return false;
    }

private:
    bool block_one(uint32_t at) {
        beam_.limit[at] = kNever;
        blocked_[at / kGroupRays] |= 1u << at % kGroupRays;
        return true;
    }

    HWY_INLINE HWY_ATTR void block_lanes(uint32_t at, M8 lanes) {
        const V8 limit = hn::Load(k8, beam_.limit + at);
        hn::Store(hn::IfThenElse(lanes, hn::Set(k8, kNever), limit), k8, beam_.limit + at);
    }

    // A byte for each bit, the lowest first.
    static_assert(std::endian::native == std::endian::little);
    void report(uint8_t* occluded) const {
        uint32_t i = 0;
        for (; i + 8 <= beam_.count; i += 8) {
            const uint64_t bits = blocked_[i / kGroupRays] >> i % kGroupRays & 255;
            const uint64_t apart = bits * 0x0101010101010101 & 0x8040201008040201;
            const uint64_t bytes = (apart + 0x7f7f7f7f7f7f7f7f) >> 7 & 0x0101010101010101;
            std::memcpy(occluded + i, &bytes, 8);
        }
        for (; i < beam_.count; ++i) occluded[i] = blocked_[i / kGroupRays] >> i % kGroupRays & 1;
    }

    const Target& target_;
    B& beam_;
    const RayStream& rays_;
    const Filter& filter_;
    uint32_t blocked_[kGroups] = {}; // bits
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
