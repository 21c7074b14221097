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

// Judges a group's candidates: `many(at, lanes, verdict, dz)` is called for eight at a time,
// `one(at, hit)` for those that stand alone or whose main axis is another; `at` counts from the
// beam's first ray, `reach(at)` is the t up to which hits count.
template <class Many, class One, class Reach>
HWY_INLINE HWY_ATTR void judge_group(const Beam& beam, const RayStream& rays, const Facets& facets,
                                     const Block& block, uint32_t lane, uint32_t group,
                                     uint32_t candidates, Many&& many, One&& one, Reach&& reach) {
    const Judge facet(facets, lane);
    uint32_t alone = candidates & beam.foreign[group];
    candidates &= ~alone;
    for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
        const uint32_t piece = candidates >> i & ((1u << kLanes8) - 1);
        if ((piece & (piece - 1)) == 0) {
            alone |= piece << i;
            continue;
        }
        const uint32_t at = group * kGroupRays + i;
        const V8 dz = hn::LoadU(k8, rays.direction[beam.kz] + beam.first + at);
        const Verdict verdict =
            judge(facet, hn::Load(k8, beam.sx + at), hn::Load(k8, beam.sy + at), dz);
        many(at, mask_of(piece), verdict, dz);
    }
    for (; alone; alone &= alone - 1) {
        const uint32_t at = group * kGroupRays + uint32_t(__builtin_ctz(alone));
        math::Ray ray = ray_at(rays, beam.first + at);
        ray.t_max = reach(at);
        geometry::TriangleHit hit;
        if (bvh::intersect(geometry::shear(ray), block, lane, hit)) one(at, hit);
    }
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

template <bool Filtered>
HWY_ATTR void closest_beam(const Target& target, Beam& beam, const RayStream& rays,
                           const Filter& filter, const HitStream& out) {
    const uint32_t padded = uint32_t(__builtin_popcount(beam.groups)) * kGroupRays;
    const HitStream hits = {out.t + beam.first,         out.u + beam.first,
                            out.v + beam.first,         out.triangle + beam.first,
                            out.back_face + beam.first, nullptr};
    const float* t_min = rays.t_min + beam.first;
    for (uint32_t i = 0; i < padded; i += kLanes8) {
        const V8 end =
            hn::Min(hn::LoadU(k8, rays.t_max + beam.first + i), hn::Set(k8, kLargestFloat));
        hn::StoreU(end, k8, hits.t + i);
        hn::StoreU(hn::Set(k8u, geometry::kNoTriangle), k8u, hits.triangle + i);
    }
    const V8 sign = hn::Set(k8, beam.sign);
    const auto test = [&](const Facets& facets, const Block& block, uint32_t lane, uint32_t group,
                          Candidates candidates) HWY_ATTR {
        const uint32_t index = block.triangle[lane];
        bool changed = false;
        const auto many = [&](uint32_t at, M8 lanes, const Verdict& verdict, V8 dz) HWY_ATTR {
            const V8 best = hn::LoadU(k8, hits.t + at);
            const auto before = hn::LoadU(k8u, hits.triangle + at);
            const M8 nearer = hn::Lt(verdict.t, best);
            const M8 ties = hn::And(hn::Eq(verdict.t, best),
                                    hn::RebindMask(k8, hn::Lt(hn::Set(k8u, index), before)));
            M8 wins = hn::And(hn::And(lanes, hn::Ge(verdict.t, hn::LoadU(k8, t_min + at))),
                              hn::Or(nearer, ties));
            wins = accepted<Filtered>(wins, filter, target.infos[index], verdict, dz);
            if (hn::AllFalse(k8, wins)) return;
            changed = true;
            const V8 z = hn::Mul(verdict.t, hn::Mul(dz, sign));
            if (hn::AllTrue(k8, wins)) {
                hn::StoreU(verdict.t, k8, hits.t + at);
                hn::StoreU(verdict.u, k8, hits.u + at);
                hn::StoreU(verdict.v, k8, hits.v + at);
                hn::StoreU(hn::Set(k8u, index), k8u, hits.triangle + at);
                hn::StoreU(back_faces(verdict, dz), k8u, hits.back_face + at);
                hn::Store(z, k8, beam.limit + at);
                return;
            }
            const auto uwins = hn::RebindMask(k8u, wins);
            const auto keep = [&](float* values, V8 value) HWY_ATTR {
                hn::StoreU(hn::IfThenElse(wins, value, hn::LoadU(k8, values)), k8, values);
            };
            hn::StoreU(hn::IfThenElse(wins, verdict.t, best), k8, hits.t + at);
            keep(hits.u + at, verdict.u);
            keep(hits.v + at, verdict.v);
            hn::StoreU(hn::IfThenElse(uwins, hn::Set(k8u, index), before), k8u, hits.triangle + at);
            hn::StoreU(
                hn::IfThenElse(uwins, back_faces(verdict, dz), hn::LoadU(k8u, hits.back_face + at)),
                k8u, hits.back_face + at);
            keep(beam.limit + at, z);
        };
        const auto one = [&](uint32_t at, const geometry::TriangleHit& hit) HWY_ATTR {
            if (!comes_first(hit.t, index, hits.t[at], hits.triangle[at])) return;
            if (Filtered && !filter.accepts(target.infos[index], hit.back_face, hit.u, hit.v))
                return;
            changed = true;
            hits.store(at, {hit.t, hit.u, hit.v, index, hit.back_face, 0});
            beam.limit[at] = hit.t * (beam.sign * rays.direction[beam.kz][beam.first + at]);
        };
        judge_group(beam, rays, facets, block, lane, group, candidates.open, many, one,
                    [&](uint32_t at) { return hits.t[at]; });
        if (changed) beam.update_limit(group);
    };
    const uint32_t steps = visit_beam(target, beam, test);
    const V8 infinity = hn::Set(k8, std::numeric_limits<float>::infinity());
    for (uint32_t i = 0; i < padded; i += kLanes8) {
        const auto missed = hn::RebindMask(
            k8, hn::Eq(hn::LoadU(k8u, hits.triangle + i), hn::Set(k8u, geometry::kNoTriangle)));
        if (!hn::AllFalse(k8, missed)) {
            const auto set = [&](float* values, V8 value) HWY_ATTR {
                hn::StoreU(hn::IfThenElse(missed, value, hn::LoadU(k8, values)), k8, values);
            };
            set(hits.t + i, infinity);
            set(hits.u + i, hn::Zero(k8));
            set(hits.v + i, hn::Zero(k8));
            const auto back = hn::LoadU(k8u, hits.back_face + i);
            hn::StoreU(hn::IfThenZeroElse(hn::RebindMask(k8u, missed), back), k8u,
                       hits.back_face + i);
        }
        if (out.steps) hn::StoreU(hn::Set(k8u, steps), k8u, out.steps + beam.first + i);
    }
}

template <bool Filtered>
HWY_ATTR void occluded_beam(const Target& target, Beam& beam, const RayStream& rays,
                            const Filter& filter, uint8_t* occluded) {
    uint32_t blocked[kGroups] = {};
    const float* t_min = rays.t_min + beam.first;
    const float* t_max = rays.t_max + beam.first;
    const auto test = [&](const Facets& facets, const Block& block, uint32_t lane, uint32_t group,
                          Candidates candidates) HWY_ATTR {
        const uint32_t index = block.triangle[lane];
        uint32_t found = 0;
        if (!Filtered && candidates.certain) {
            found = candidates.certain;
            for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
                float* limit = beam.limit + group * kGroupRays + i;
                hn::Store(
                    hn::IfThenElse(mask_of(found >> i), hn::Set(k8, -1.0f), hn::Load(k8, limit)),
                    k8, limit);
            }
            candidates.open &= ~found;
        }
        const auto many = [&](uint32_t at, M8 lanes, const Verdict& verdict, V8 dz) HWY_ATTR {
            const V8 end = hn::Min(hn::LoadU(k8, t_max + at), hn::Set(k8, kLargestFloat));
            const M8 in_range =
                hn::And(hn::Ge(verdict.t, hn::LoadU(k8, t_min + at)), hn::Le(verdict.t, end));
            const M8 hit = accepted<Filtered>(hn::And(lanes, in_range), filter, target.infos[index],
                                              verdict, dz);
            hn::Store(hn::IfThenElse(hit, hn::Set(k8, -1.0f), hn::Load(k8, beam.limit + at)), k8,
                      beam.limit + at);
            found |= bits_of(k8, hit) << at % kGroupRays;
        };
        const auto one = [&](uint32_t at, const geometry::TriangleHit& hit) HWY_ATTR {
            if (Filtered && !filter.accepts(target.infos[index], hit.back_face, hit.u, hit.v))
                return;
            beam.limit[at] = -1;
            found |= 1u << at % kGroupRays;
        };
        if (candidates.open)
            judge_group(beam, rays, facets, block, lane, group, candidates.open, many, one,
                        [&](uint32_t at) { return t_max[at]; });
        if (found == 0) return;
        blocked[group] |= found;
        beam.update_limit(group);
    };
    visit_beam(target, beam, test);
    for (uint32_t i = 0; i < beam.count; ++i)
        occluded[beam.first + i] = blocked[i / kGroupRays] >> i % kGroupRays & 1;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
