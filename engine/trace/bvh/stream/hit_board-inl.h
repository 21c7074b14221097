// The closest hits so far of a stream's rays. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_STREAM_HIT_BOARD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_STREAM_HIT_BOARD_INL_H
#undef PEREGRINE_TRACE_BVH_STREAM_HIT_BOARD_INL_H
#else
#define PEREGRINE_TRACE_BVH_STREAM_HIT_BOARD_INL_H
#endif

#include <hwy/highway.h>

#include "geometry/intersect.h"
#include "simd/lanes-inl.h"
#include "trace/eight_rays-inl.h"
#include "trace/kernels.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;
using namespace trace::HWY_NAMESPACE;

// Rays count from `first` of the streams. While a ray has no hit, its t is where it ends. Until
// finish() triangles are keys.
class HitBoard {
public:
    HWY_ATTR HitBoard(const RayStream& rays, const HitStream& out, uint32_t first, uint32_t count)
        : hits_{out.t + first,         out.u + first,
                out.v + first,         out.triangle + first,
                out.back_face + first, out.steps ? out.steps + first : nullptr},
          count_(count) {
        for (uint32_t i = 0; i < count; i += kLanes8) {
            const V8 end =
                hn::Min(hn::LoadU(k8, rays.t_max + first + i), hn::Set(k8, kLargestFloat));
            hn::StoreU(end, k8, hits_.t + i);
            hn::StoreU(hn::Set(k8u, geometry::kNoTriangle), k8u, hits_.triangle + i);
        }
    }

    float t(uint32_t at) const { return hits_.t[at]; }
    const float* all_t() const { return hits_.t; }
    HWY_INLINE HWY_ATTR V8 best(uint32_t at) const { return hn::LoadU(k8, hits_.t + at); }

    // Of the eight rays from `at` on those that the hits come first for.
    HWY_INLINE HWY_ATTR M8 find_wins(uint32_t at, const EightHits& hits, V8u keys) const {
        const V8u before = hn::LoadU(k8u, hits_.triangle + at);
        return hn::And(hits.lanes,
                       trace::HWY_NAMESPACE::comes_first(hits.t, keys, best(at), before));
    }

    HWY_INLINE HWY_ATTR void record(uint32_t at, M8 wins, const EightHits& hits, V8u keys) {
        if (hn::AllTrue(k8, wins)) {
            hn::StoreU(hits.t, k8, hits_.t + at);
            hn::StoreU(hits.u, k8, hits_.u + at);
            hn::StoreU(hits.v, k8, hits_.v + at);
            hn::StoreU(keys, k8u, hits_.triangle + at);
            return;
        }
        replace(wins, hits.t, hits_.t + at);
        replace(wins, hits.u, hits_.u + at);
        replace(wins, hits.v, hits_.v + at);
        replace(wins, keys, hits_.triangle + at);
    }

    bool comes_first(uint32_t at, const geometry::TriangleHit& hit, uint32_t index) const {
        return trace::comes_first(hit.t, key_of(index, hit.back_face), hits_.t[at],
                                  hits_.triangle[at]);
    }
    void record_one(uint32_t at, const geometry::TriangleHit& hit, uint32_t index) {
        hits_.t[at] = hit.t;
        hits_.u[at] = hit.u;
        hits_.v[at] = hit.v;
        hits_.triangle[at] = key_of(index, hit.back_face);
    }

    // Gives keys and misses their form.
    HWY_ATTR void finish(uint32_t steps) {
        for (uint32_t i = 0; i < count_; i += kLanes8) {
            if (hits_.steps) hn::StoreU(hn::Set(k8u, steps), k8u, hits_.steps + i);
            const Named named(hn::LoadU(k8u, hits_.triangle + i));
            hn::StoreU(named.triangle, k8u, hits_.triangle + i);
            hn::StoreU(named.back_face, k8u, hits_.back_face + i);
            if (hn::AllFalse(k8, named.missed)) continue;
            replace(named.missed, hn::Set(k8, std::numeric_limits<float>::infinity()), hits_.t + i);
            replace(named.missed, hn::Zero(k8), hits_.u + i);
            replace(named.missed, hn::Zero(k8), hits_.v + i);
        }
    }

    HWY_INLINE HWY_ATTR static void replace(M8 lanes, V8 value, float* values) {
        hn::StoreU(hn::IfThenElse(lanes, value, hn::LoadU(k8, values)), k8, values);
    }
    HWY_INLINE HWY_ATTR static void replace(M8 lanes, V8u value, uint32_t* values) {
        hn::StoreU(hn::IfThenElse(hn::RebindMask(k8u, lanes), value, hn::LoadU(k8u, values)), k8u,
                   values);
    }

private:
    HitStream hits_;
    uint32_t count_;
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
