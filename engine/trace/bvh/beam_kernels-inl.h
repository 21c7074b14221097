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
#include "trace/bvh/plain.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

// The canonical test for eight rays of a beam, of which `maybe` are in question.
HWY_INLINE HWY_ATTR bool decide(const Beam& beam, const RayStream& rays, const Facets& facets,
                                uint32_t lane, uint32_t at, M8 maybe, V8 t_max, PacketHit& hit) {
    const V8 sign = hn::Set(k8, beam.sign);
    const V8 sx = hn::Mul(hn::Load(k8, beam.p + at), sign);
    const V8 sy = hn::Mul(hn::Load(k8, beam.q + at), sign);
    trace::HWY_NAMESPACE::ShearedTriangle s;
    const auto shear = [&](int i, V8& x, V8& y, V8& z) HWY_ATTR {
        z = hn::Set(k8, facets.vertex[i][2][lane]);
        x = hn::Sub(hn::Set(k8, facets.vertex[i][0][lane]), hn::Mul(sx, z));
        y = hn::Sub(hn::Set(k8, facets.vertex[i][1][lane]), hn::Mul(sy, z));
    };
    shear(0, s.ax, s.ay, s.az);
    shear(1, s.bx, s.by, s.bz);
    shear(2, s.cx, s.cy, s.cz);
    const V8 dz = hn::Mul(hn::Load(k8, beam.scale + at), sign);
    const V8 t_min = hn::LoadU(k8, rays.t_min + beam.first + at);
    return trace::HWY_NAMESPACE::decide(s, dz, maybe, t_min, t_max, hit);
}

// ... and for one.
inline HWY_ATTR bool decide_one(const RayStream& rays, const Block& block, uint32_t lane,
                                uint32_t at, float t_max, geometry::TriangleHit& hit) {
    math::Ray ray = ray_at(rays, at);
    ray.t_max = t_max;
    return bvh::intersect(geometry::shear(ray), block, lane, hit);
}

template <bool Filtered>
HWY_ATTR void closest_beam(const Target& target, Beam& beam, const RayStream& rays,
                           const Filter& filter, const HitStream& hits) {
    const uint32_t padded = uint32_t(__builtin_popcount(beam.groups)) * kGroupRays;
    for (uint32_t i = 0; i < padded; i += kLanes8) {
        const uint32_t to = beam.first + i;
        hn::StoreU(hn::LoadU(k8, rays.t_max + to), k8, hits.t + to);
        hn::StoreU(hn::Zero(k8), k8, hits.u + to);
        hn::StoreU(hn::Zero(k8), k8, hits.v + to);
        const hn::RebindToUnsigned<D8> u8;
        hn::StoreU(hn::Set(u8, geometry::kNoTriangle), u8, hits.triangle + to);
        hn::StoreU(hn::Zero(u8), u8, hits.back_face + to);
    }
    const hn::RebindToUnsigned<D8> u8;
    const uint32_t steps = visit_beam(
        target, beam,
        [&](const Facets& facets, const Block& block, uint32_t lane, uint32_t group,
            uint32_t candidates) HWY_ATTR {
            const uint32_t index = block.triangle[lane];
            bool changed = false;
            uint32_t single = candidates & beam.foreign[group];
            for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
                uint32_t piece = (candidates & ~single) >> i & ((1u << kLanes8) - 1);
                if (piece == 0) continue;
                if ((piece & (piece - 1)) == 0) {
                    single |= piece << i;
                    continue;
                }
                const uint32_t at = group * kGroupRays + i;
                const uint32_t to = beam.first + at;
                const uint8_t byte = uint8_t(piece);
                const M8 maybe = hn::LoadMaskBits(k8, &byte);
                const V8 best = hn::LoadU(k8, hits.t + to);
                PacketHit hit;
                if (!decide(beam, rays, facets, lane, at, maybe, best, hit)) continue;
                const auto before = hn::LoadU(u8, hits.triangle + to);
                M8 wins = hn::And(hit.lanes,
                                  hn::Or(hn::Lt(hit.t, best),
                                         hn::RebindMask(k8, hn::Lt(hn::Set(u8, index), before))));
                if (Filtered)
                    wins = trace::HWY_NAMESPACE::accepted(wins, filter, target.infos[index], hit);
                if (hn::AllFalse(k8, wins)) continue;
                changed = true;
                hn::StoreU(hn::IfThenElse(wins, hit.t, best), k8, hits.t + to);
                hn::StoreU(hn::IfThenElse(wins, hit.u, hn::LoadU(k8, hits.u + to)), k8,
                           hits.u + to);
                hn::StoreU(hn::IfThenElse(wins, hit.v, hn::LoadU(k8, hits.v + to)), k8,
                           hits.v + to);
                const auto uwins = hn::RebindMask(u8, wins);
                hn::StoreU(hn::IfThenElse(uwins, hn::Set(u8, index), before), u8,
                           hits.triangle + to);
                hn::StoreU(hn::IfThenElse(uwins, hn::BitCast(u8, hit.back),
                                          hn::LoadU(u8, hits.back_face + to)),
                           u8, hits.back_face + to);
                const V8 limit = hn::Load(k8, beam.limit + at);
                const V8 z = hn::Mul(hit.t, hn::Load(k8, beam.scale + at));
                hn::Store(hn::IfThenElse(wins, z, limit), k8, beam.limit + at);
            }
            for (; single; single &= single - 1) {
                const uint32_t at = group * kGroupRays + uint32_t(__builtin_ctz(single));
                const uint32_t to = beam.first + at;
                geometry::TriangleHit hit;
                if (!decide_one(rays, block, lane, to, hits.t[to], hit)) continue;
                if (!comes_first(hit.t, index, hits.t[to], hits.triangle[to])) continue;
                if (Filtered && !filter.accepts(target.infos[index], hit.back_face, hit.u, hit.v))
                    continue;
                changed = true;
                hits.store(to, {hit.t, hit.u, hit.v, index, hit.back_face, 0});
                beam.limit[at] = hit.t * beam.scale[at];
            }
            if (changed) beam.update_limit(group);
        });
    const V8 infinity = hn::Set(k8, std::numeric_limits<float>::infinity());
    for (uint32_t i = 0; i < padded; i += kLanes8) {
        const uint32_t to = beam.first + i;
        const auto missed = hn::RebindMask(
            k8, hn::Eq(hn::LoadU(u8, hits.triangle + to), hn::Set(u8, geometry::kNoTriangle)));
        hn::StoreU(hn::IfThenElse(missed, infinity, hn::LoadU(k8, hits.t + to)), k8, hits.t + to);
        if (hits.steps) hn::StoreU(hn::Set(u8, steps), u8, hits.steps + to);
    }
}

template <bool Filtered>
HWY_ATTR void occluded_beam(const Target& target, Beam& beam, const RayStream& rays,
                            const Filter& filter, uint8_t* occluded) {
    uint32_t blocked[kGroups] = {};
    visit_beam(target, beam,
               [&](const Facets& facets, const Block& block, uint32_t lane, uint32_t group,
                   uint32_t candidates) HWY_ATTR {
                   const uint32_t index = block.triangle[lane];
                   uint32_t found = 0;
                   uint32_t single = candidates & beam.foreign[group];
                   for (uint32_t i = 0; i < kGroupRays; i += kLanes8) {
                       uint32_t piece = (candidates & ~single) >> i & ((1u << kLanes8) - 1);
                       if (piece == 0) continue;
                       if ((piece & (piece - 1)) == 0) {
                           single |= piece << i;
                           continue;
                       }
                       const uint32_t at = group * kGroupRays + i;
                       const uint8_t byte = uint8_t(piece);
                       const M8 maybe = hn::LoadMaskBits(k8, &byte);
                       PacketHit hit;
                       if (!decide(beam, rays, facets, lane, at, maybe,
                                   hn::LoadU(k8, rays.t_max + beam.first + at), hit))
                           continue;
                       if (Filtered)
                           hit.lanes = trace::HWY_NAMESPACE::accepted(hit.lanes, filter,
                                                                      target.infos[index], hit);
                       found |= bits_of(k8, hit.lanes) << i;
                   }
                   for (; single; single &= single - 1) {
                       const uint32_t i = uint32_t(__builtin_ctz(single));
                       const uint32_t at = beam.first + group * kGroupRays + i;
                       geometry::TriangleHit hit;
                       if (decide_one(rays, block, lane, at, rays.t_max[at], hit)
                           && (!Filtered
                               || filter.accepts(target.infos[index], hit.back_face, hit.u, hit.v)))
                           found |= 1u << i;
                   }
                   if (found == 0) return;
                   blocked[group] |= found;
                   for (uint32_t bits = found; bits; bits &= bits - 1)
                       beam.limit[group * kGroupRays + uint32_t(__builtin_ctz(bits))] = -1;
                   beam.update_limit(group);
               });
    for (uint32_t i = 0; i < beam.count; ++i)
        occluded[beam.first + i] = blocked[i / kGroupRays] >> i % kGroupRays & 1;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
