// What pencils are traced for: closest hits, or whether there is one. Included once for each
// instruction set.
#if defined(PEREGRINE_TRACE_BVH_PENCIL_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_PENCIL_KERNELS_INL_H
#undef PEREGRINE_TRACE_BVH_PENCIL_KERNELS_INL_H
#else
#define PEREGRINE_TRACE_BVH_PENCIL_KERNELS_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/pencil/traversal-inl.h"
#include "trace/bvh/stream/hit_board-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// A triangle relative to eight rays of a bundle whose main axis is the pencil's: step 3 of
// geometry/intersect.h.
HWY_INLINE HWY_ATTR Sheared<V8> relative_to(const Pencil& pencil, const RayStream& rays,
                                            uint32_t at, const Block& block, uint32_t lane) {
    const uint32_t ray = pencil.first + at;
    const V8 ox = hn::LoadU(k8, rays.origin[pencil.kx] + ray);
    const V8 oy = hn::LoadU(k8, rays.origin[pencil.ky] + ray);
    const V8 oz = hn::LoadU(k8, rays.origin[pencil.kz] + ray);
    const V8 sx = hn::Load(k8, pencil.sx + at), sy = hn::Load(k8, pencil.sy + at);
    const auto corner = [&](int i, V8& x, V8& y, V8& z) HWY_ATTR __attribute__((always_inline)) {
        z = hn::Sub(hn::Set(k8, block.vertex[i][pencil.kz][lane]), oz);
        x = shear(hn::Sub(hn::Set(k8, block.vertex[i][pencil.kx][lane]), ox), sx, z);
        y = shear(hn::Sub(hn::Set(k8, block.vertex[i][pencil.ky][lane]), oy), sy, z);
    };
    Sheared<V8> s;
    corner(0, s.ax, s.ay, s.az);
    corner(1, s.bx, s.by, s.bz);
    corner(2, s.cx, s.cy, s.cz);
    return s;
}

// Tests a bundle: `take(at, hit)` hears of hits within [t_min, end(at)], eight rays at a time,
// `take_one(at, hit)` of those of rays with another main axis. Returns whether any was taken.
template <class End, class Take, class TakeOne>
HWY_INLINE HWY_ATTR bool test_bundle(const Pencil& pencil, const RayStream& rays,
                                     const Block& block, uint32_t lane, uint32_t bundle, End&& end,
                                     Take&& take, TakeOne&& take_one) {
    bool taken = false;
    for (uint32_t i = 0; i < kBundleRays; i += kLanes8) {
        const uint32_t at = bundle * kBundleRays + i;
        const M8 open = hn::Ge(hn::Load(k8, pencil.limit + at), hn::Zero(k8));
        const M8 native = mask_of(~uint32_t(pencil.foreign[bundle]) >> i & 255u);
        const Sheared<V8> s = relative_to(pencil, rays, at, block, lane);
        const M8 maybe = hn::AndNot(outside(s), hn::And(open, native));
        if (hn::AllFalse(k8, maybe)) continue;
        const V8 dz = hn::LoadU(k8, rays.direction[pencil.kz] + pencil.first + at);
        const V8 begin = hn::LoadU(k8, rays.t_min + pencil.first + at);
        const EightHits hits = decide(s, dz, maybe, begin, end(at));
        if (!hn::AllFalse(k8, hits.lanes)) taken |= take(at, hits);
    }
    for (uint32_t left = pencil.foreign[bundle]; left; left &= left - 1) {
        const uint32_t at = bundle * kBundleRays + uint32_t(__builtin_ctz(left));
        if (pencil.limit[at] < 0) continue;
        const math::Ray ray = ray_at(rays, pencil.first + at);
        geometry::TriangleHit hit;
        if (bvh::intersect(geometry::shear(ray), block, lane, hit)) taken |= take_one(at, hit);
    }
    return taken;
}

template <bool Filtered>
class ClosestPencil {
public:
    HWY_ATTR ClosestPencil(const Target& target, Pencil& pencil, const RayStream& rays,
                           const Filter& filter, const HitStream& out)
        : target_(target), pencil_(pencil), rays_(rays), filter_(filter),
          board_(rays, out, pencil.first, pencil.count) {}

    HWY_ATTR void trace() { board_.finish(visit_pencil(target_, pencil_, *this)); }

    HWY_INLINE HWY_ATTR void test(const Block& block, uint32_t lane, uint32_t bundle) {
        const uint32_t index = block.triangle[lane];
        const auto take = [&](uint32_t at, const EightHits& hit) HWY_ATTR {
            const V8u keys = keys_of(index, hit);
            M8 wins = board_.find_wins(at, hit, keys);
            if (Filtered) wins = accepted(wins, filter_, target_.infos[index], hit);
            if (hn::AllFalse(k8, wins)) return false;
            board_.record(at, wins, hit, keys);
            const uint32_t ray = pencil_.first + at;
            const V8 sign = hn::Set(k8, pencil_.sign);
            const V8 foot = hn::Mul(hn::Sub(hn::LoadU(k8, rays_.origin[pencil_.kz] + ray),
                                            hn::Set(k8, pencil_.plane_z)),
                                    sign);
            const V8 scale = hn::Mul(hn::LoadU(k8, rays_.direction[pencil_.kz] + ray), sign);
            HitBoard::replace(wins, hn::MulAdd(hit.t, scale, foot), pencil_.limit + at);
            return true;
        };
        const auto take_one = [&](uint32_t at, const geometry::TriangleHit& hit) HWY_ATTR {
            if (!board_.comes_first(at, hit, index)
                || (Filtered
                    && !filter_.accepts(target_.infos[index], hit.back_face, hit.u, hit.v)))
                return false;
            board_.record_one(at, hit, index);
            const uint32_t ray = pencil_.first + at;
            pencil_.limit[at] = pencil_.sign
                                * ((rays_.origin[pencil_.kz][ray] - pencil_.plane_z)
                                   + hit.t * rays_.direction[pencil_.kz][ray]);
            return true;
        };
        const auto end = [&](uint32_t at) HWY_ATTR { return board_.best(at); };
        if (test_bundle(pencil_, rays_, block, lane, bundle, end, take, take_one))
            pencil_.update_limit(bundle);
    }

private:
    const Target& target_;
    Pencil& pencil_;
    const RayStream& rays_;
    const Filter& filter_;
    HitBoard board_;
};

template <bool Filtered>
class OccludedPencil {
public:
    HWY_ATTR OccludedPencil(const Target& target, Pencil& pencil, const RayStream& rays,
                            const Filter& filter)
        : target_(target), pencil_(pencil), rays_(rays), filter_(filter) {}

    HWY_ATTR void trace(uint8_t* occluded) {
        visit_pencil(target_, pencil_, *this);
        for (uint32_t i = 0; i < pencil_.count; ++i)
            occluded[pencil_.first + i] = blocked_[i / kBundleRays] >> i % kBundleRays & 1;
    }

    HWY_INLINE HWY_ATTR void test(const Block& block, uint32_t lane, uint32_t bundle) {
        const auto& info = target_.infos[block.triangle[lane]];
        const auto take = [&](uint32_t at, const EightHits& hit) HWY_ATTR {
            M8 lanes = hit.lanes;
            if (Filtered) lanes = accepted(lanes, filter_, info, hit);
            if (hn::AllFalse(k8, lanes)) return false;
            HitBoard::replace(lanes, hn::Set(k8, -1.0f), pencil_.limit + at);
            blocked_[bundle] |= uint8_t(bits_of(k8, lanes) << at % kBundleRays);
            return true;
        };
        const auto take_one = [&](uint32_t at, const geometry::TriangleHit& hit) HWY_ATTR {
            if (Filtered && !filter_.accepts(info, hit.back_face, hit.u, hit.v)) return false;
            pencil_.limit[at] = -1;
            blocked_[bundle] |= uint8_t(1u << at % kBundleRays);
            return true;
        };
        const auto end = [&](uint32_t at)
                             HWY_ATTR { return hn::LoadU(k8, rays_.t_max + pencil_.first + at); };
        if (test_bundle(pencil_, rays_, block, lane, bundle, end, take, take_one))
            pencil_.update_limit(bundle);
    }

private:
    const Target& target_;
    Pencil& pencil_;
    const RayStream& rays_;
    const Filter& filter_;
    uint8_t blocked_[kBundles] = {}; // bits
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
