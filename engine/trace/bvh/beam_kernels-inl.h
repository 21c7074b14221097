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
#include "trace/bvh/beam_traversal-inl.h"
#include "trace/bvh/decide-inl.h"
#include "trace/bvh/plain.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using D8u = hn::RebindToUnsigned<D8>;
constexpr D8u k8u;
constexpr float kLargestFloat = std::numeric_limits<float>::max();

// Judges a group's candidates: kernel.take(at, lanes, verdict, dz, index) hears of eight at a time,
// kernel.test_one(block, lane, at) is asked for those that stand alone or whose main axis is
// another; `at` counts from the beam's first ray. Returns whether the kernel changed a limit.
template <bool Inside, class Kernel>
HWY_INLINE HWY_ATTR bool judge_group(const Beam& beam, const RayStream& rays, const Facets& facets,
                                     const Block& block, uint32_t lane, uint32_t group,
                                     uint32_t candidates, Kernel& kernel) {
    const Judge facet(facets, lane);
    uint32_t alone = candidates & beam.foreign[group];
    candidates &= ~alone;
    bool changed = false;
    for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
        const uint32_t piece = candidates >> i & ((1u << kLanes8) - 1);
        if ((piece & (piece - 1)) == 0) {
            alone |= piece << i;
            continue;
        }
        const uint32_t at = group * kGroupRays + i;
        const V8 dz = hn::LoadU(k8, rays.direction[beam.kz] + beam.first + at);
        const Verdict verdict =
            judge<Inside>(facet, hn::Load(k8, beam.sx + at), hn::Load(k8, beam.sy + at), dz);
        changed |= kernel.take(at, mask_of(piece), verdict, dz, block.triangle[lane]);
    }
    for (; alone; alone &= alone - 1)
        changed |=
            kernel.test_one(block, lane, group * kGroupRays + uint32_t(__builtin_ctz(alone)));
    return changed;
}

// 1 in lanes where the side seen is the clockwise one.
HWY_INLINE HWY_ATTR hn::Vec<D8u> back_faces(const Verdict& verdict, V8 dz) {
    return hn::ShiftRight<31>(hn::BitCast(k8u, hn::Xor(verdict.det, dz)));
}

template <bool Filtered>
HWY_INLINE HWY_ATTR M8 accepted(M8 lanes, const Filter& filter, const geometry::TriangleInfo& info,
                                const Verdict& verdict, V8 dz) {
    if (!Filtered) return lanes;
    const PacketHit hit{lanes, verdict.t, verdict.u, verdict.v,
                        hn::BitCast(k8, back_faces(verdict, dz))};
    return trace::HWY_NAMESPACE::accepted(lanes, filter, info, hit);
}

// The canonical test for one ray, with t up to `end`.
HWY_INLINE HWY_ATTR bool intersect_one(const RayStream& rays, uint32_t at, float end,
                                       const Block& block, uint32_t lane,
                                       geometry::TriangleHit& hit) {
    math::Ray ray = ray_at(rays, at);
    ray.t_max = end;
    return bvh::intersect(geometry::shear(ray), block, lane, hit);
}

template <bool Filtered>
class ClosestBeam {
public:
    HWY_ATTR ClosestBeam(const Target& target, Beam& beam, const RayStream& rays,
                         const Filter& filter, const HitStream& out)
        : target_(target), beam_(beam), rays_(rays), filter_(filter), out_(out),
          hits_{out.t + beam.first,        out.u + beam.first,         out.v + beam.first,
                out.triangle + beam.first, out.back_face + beam.first, nullptr} {}

    HWY_ATTR void trace() {
        for (uint32_t i = 0; i < beam_.count; i += kLanes8) {
            const V8 end =
                hn::Min(hn::LoadU(k8, rays_.t_max + beam_.first + i), hn::Set(k8, kLargestFloat));
            hn::StoreU(end, k8, hits_.t + i);
            hn::StoreU(hn::Set(k8u, geometry::kNoTriangle), k8u, hits_.triangle + i);
        }
        const uint32_t steps = visit_beam(target_, beam_, *this);
        for (uint32_t i = 0; i < beam_.count; i += kLanes8) {
            finish_missed(i);
            if (out_.steps) hn::StoreU(hn::Set(k8u, steps), k8u, out_.steps + beam_.first + i);
        }
    }

    HWY_INLINE HWY_ATTR void judge(const Facets& facets, const Block& block, uint32_t lane,
                                   uint32_t group, const Candidates& rays) {
        const bool changed =
            rays.inside
                ? judge_group<true>(beam_, rays_, facets, block, lane, group, rays.open, *this)
                : judge_group<false>(beam_, rays_, facets, block, lane, group, rays.open, *this);
        if (changed) beam_.update_limit(group);
    }

    HWY_INLINE HWY_ATTR bool take(uint32_t at, M8 lanes, const Verdict& verdict, V8 dz,
                                  uint32_t index) {
        const V8 best = hn::LoadU(k8, hits_.t + at);
        const auto before = hn::LoadU(k8u, hits_.triangle + at);
        const M8 nearer = hn::Lt(verdict.t, best);
        const M8 ties = hn::And(hn::Eq(verdict.t, best),
                                hn::RebindMask(k8, hn::Lt(hn::Set(k8u, index), before)));
        const V8 begin = hn::LoadU(k8, rays_.t_min + beam_.first + at);
        M8 wins = hn::And(hn::And(lanes, hn::Ge(verdict.t, begin)), hn::Or(nearer, ties));
        wins = accepted<Filtered>(wins, filter_, target_.infos[index], verdict, dz);
        if (hn::AllFalse(k8, wins)) return false;
        const V8 z = hn::Mul(verdict.t, hn::Mul(dz, hn::Set(k8, beam_.sign)));
        if (hn::AllTrue(k8, wins)) {
            hn::StoreU(verdict.t, k8, hits_.t + at);
            hn::StoreU(verdict.u, k8, hits_.u + at);
            hn::StoreU(verdict.v, k8, hits_.v + at);
            hn::StoreU(hn::Set(k8u, index), k8u, hits_.triangle + at);
            hn::StoreU(back_faces(verdict, dz), k8u, hits_.back_face + at);
            hn::Store(z, k8, beam_.limit + at);
            return true;
        }
        replace(wins, verdict.t, hits_.t + at);
        replace(wins, verdict.u, hits_.u + at);
        replace(wins, verdict.v, hits_.v + at);
        replace(wins, hn::Set(k8u, index), hits_.triangle + at);
        replace(wins, back_faces(verdict, dz), hits_.back_face + at);
        replace(wins, z, beam_.limit + at);
        return true;
    }

    HWY_INLINE HWY_ATTR bool test_one(const Block& block, uint32_t lane, uint32_t at) {
        const uint32_t index = block.triangle[lane];
        geometry::TriangleHit hit;
        if (!intersect_one(rays_, beam_.first + at, hits_.t[at], block, lane, hit)
            || !comes_first(hit.t, index, hits_.t[at], hits_.triangle[at])
            || (Filtered && !filter_.accepts(target_.infos[index], hit.back_face, hit.u, hit.v)))
            return false;
        hits_.store(at, {hit.t, hit.u, hit.v, index, hit.back_face, 0});
        beam_.limit[at] = hit.t * (beam_.sign * rays_.direction[beam_.kz][beam_.first + at]);
        return true;
    }

private:
    HWY_INLINE HWY_ATTR static void replace(M8 lanes, V8 value, float* values) {
        hn::StoreU(hn::IfThenElse(lanes, value, hn::LoadU(k8, values)), k8, values);
    }
    HWY_INLINE HWY_ATTR static void replace(M8 lanes, hn::Vec<D8u> value, uint32_t* values) {
        hn::StoreU(hn::IfThenElse(hn::RebindMask(k8u, lanes), value, hn::LoadU(k8u, values)), k8u,
                   values);
    }

    HWY_INLINE HWY_ATTR void finish_missed(uint32_t i) {
        const M8 missed = hn::RebindMask(
            k8, hn::Eq(hn::LoadU(k8u, hits_.triangle + i), hn::Set(k8u, geometry::kNoTriangle)));
        if (hn::AllFalse(k8, missed)) return;
        replace(missed, hn::Set(k8, std::numeric_limits<float>::infinity()), hits_.t + i);
        replace(missed, hn::Zero(k8), hits_.u + i);
        replace(missed, hn::Zero(k8), hits_.v + i);
        replace(missed, hn::Zero(k8u), hits_.back_face + i);
    }

    const Target& target_;
    Beam& beam_;
    const RayStream& rays_;
    const Filter& filter_;
    const HitStream& out_;
    HitStream hits_; // from the beam's first ray on
};

template <bool Filtered>
class OccludedBeam {
public:
    HWY_ATTR OccludedBeam(const Target& target, Beam& beam, const RayStream& rays,
                          const Filter& filter)
        : target_(target), beam_(beam), rays_(rays), filter_(filter) {}

    HWY_ATTR void trace(uint8_t* occluded) {
        visit_beam(target_, beam_, *this);
        for (uint32_t i = 0; i < beam_.count; ++i)
            occluded[beam_.first + i] = blocked_[i / kGroupRays] >> i % kGroupRays & 1;
    }

    HWY_INLINE HWY_ATTR void judge(const Facets& facets, const Block& block, uint32_t lane,
                                   uint32_t group, const Candidates& rays) {
        const uint32_t certain = Filtered ? 0 : rays.certain;
        for (uint32_t i = 0; certain && i < kGroupRays; i += kLanes8)
            block_lanes(group * kGroupRays + i, mask_of(certain >> i));
        blocked_[group] |= certain;
        const uint32_t open = rays.open & ~certain;
        const bool changed =
            open && judge_group<false>(beam_, rays_, facets, block, lane, group, open, *this);
        if (certain || changed) beam_.update_limit(group);
    }

    HWY_INLINE HWY_ATTR bool take(uint32_t at, M8 lanes, const Verdict& verdict, V8 dz,
                                  uint32_t index) {
        const V8 begin = hn::LoadU(k8, rays_.t_min + beam_.first + at);
        const V8 end =
            hn::Min(hn::LoadU(k8, rays_.t_max + beam_.first + at), hn::Set(k8, kLargestFloat));
        const M8 in_range = hn::And(hn::Ge(verdict.t, begin), hn::Le(verdict.t, end));
        const M8 hit = accepted<Filtered>(hn::And(lanes, in_range), filter_, target_.infos[index],
                                          verdict, dz);
        if (hn::AllFalse(k8, hit)) return false;
        block_lanes(at, hit);
        blocked_[at / kGroupRays] |= bits_of(k8, hit) << at % kGroupRays;
        return true;
    }

    HWY_INLINE HWY_ATTR bool test_one(const Block& block, uint32_t lane, uint32_t at) {
        if (beam_.limit[at] < 0) return false; // already
        geometry::TriangleHit hit;
        if (!intersect_one(rays_, beam_.first + at, rays_.t_max[beam_.first + at], block, lane, hit)
            || (Filtered
                && !filter_.accepts(target_.infos[block.triangle[lane]], hit.back_face, hit.u,
                                    hit.v)))
            return false;
        beam_.limit[at] = -1;
        blocked_[at / kGroupRays] |= 1u << at % kGroupRays;
        return true;
    }

private:
    HWY_INLINE HWY_ATTR void block_lanes(uint32_t at, M8 lanes) {
        const V8 limit = hn::Load(k8, beam_.limit + at);
        hn::Store(hn::IfThenElse(lanes, hn::Set(k8, -1.0f), limit), k8, beam_.limit + at);
    }

    const Target& target_;
    Beam& beam_;
    const RayStream& rays_;
    const Filter& filter_;
    uint32_t blocked_[kGroups] = {}; // bits
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
