// What a light map says of the points of a batch. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_RECALL_LIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_RECALL_LIGHT_INL_H
#undef PEREGRINE_SHADE_RECALL_LIGHT_INL_H
#else
#define PEREGRINE_SHADE_RECALL_LIGHT_INL_H
#endif

#include "geometry/triangle.h"
#include "scene/light_map.h"
#include "shade/surface/ray_hits.h"
#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Where the hits of a vector lie in their triangles' grids: scene::GridPlace. Only the fronts of
// fixed triangles have any.
struct GridPlaces {
    Mf known;
    Vi index[3]; // of values
    Vf weight[3];

    HWY_INLINE GridPlaces(const scene::PointGrids& grids, const RayHits& hits, uint32_t i) {
        using scene::PointGrids;
        const auto one = hn::Set(kI, 1);
        const Vf zero = hn::Zero(kF), whole = splat(1.0f);
        const Vu triangle = hn::LoadU(kU, hits.triangle + i);
        const auto is_fixed = hn::Lt(triangle, hn::Set(kU, uint32_t(grids.grids.size())));
        const auto is_front = hn::Eq(hn::LoadU(kU, hits.back_face + i), hn::Zero(kU));
        const auto has = hn::And(hn::FirstN(kU, hits.count - i), hn::And(is_fixed, is_front));
        known = hn::RebindMask(kF, has);
        const Vu bits = hn::GatherIndex(kU, grids.grids.data(),
                                        hn::BitCast(kI, hn::IfThenElseZero(has, triangle)));
        const Vi level = hn::BitCast(kI, hn::ShiftRight<PointGrids::kLevelShift>(bits));
        const Vi first = hn::BitCast(kI, hn::And(bits, hn::Set(kU, PointGrids::kMostPoints - 1)));
        const Vi side = hn::Shl(one, level);
        const Vf wide = hn::ConvertTo(kF, side);
        const Vf u = hn::IfThenElseZero(known, hn::LoadU(kF, hits.u + i));
        const Vf v = hn::IfThenElseZero(known, hn::LoadU(kF, hits.v + i));
        const Vf x = hn::Min(hn::Max(hn::Mul(u, wide), zero), wide);
        const Vf y = hn::Min(hn::Max(hn::Mul(v, wide), zero), wide);
        const Vi last = hn::Sub(side, one);
        const Vi iv = hn::Min(hn::ConvertTo(kI, y), last);
        const Vi iu = hn::Min(hn::ConvertTo(kI, x), hn::Sub(last, iv));
        const Vf fu = hn::Sub(x, hn::ConvertTo(kF, iu)), fv = hn::Sub(y, hn::ConvertTo(kF, iv));
        const Mf upper = hn::And(hn::Gt(hn::Add(fu, fv), whole),
                                 hn::RebindMask(kF, hn::Lt(hn::Add(iu, iv), last)));
        const auto upper_i = hn::RebindMask(kI, upper);
        const Vi twice = hn::Add(hn::ShiftLeft<1>(side), hn::Set(kI, 3));
        const Vi row = hn::ShiftRight<1>(hn::Mul(iv, hn::Sub(twice, iv)));
        const Vi at = hn::Add(hn::Add(first, row), iu);
        const Vi above = hn::Sub(hn::Add(side, one), iv); // how much further the next row is
        index[0] = hn::Add(at, hn::IfThenElseZero(upper_i, hn::Add(above, one)));
        index[1] = hn::Add(at, hn::IfThenElse(upper_i, above, one));
        index[2] = hn::Add(at, hn::IfThenElse(upper_i, one, above));
        weight[1] = hn::IfThenElse(upper, hn::Sub(whole, fu), fu);
        weight[2] = hn::IfThenElse(upper, hn::Sub(whole, fv), fv);
        weight[0] = hn::Max(hn::Sub(hn::Sub(whole, weight[1]), weight[2]), zero);
    }
};

// Where nothing is known it is -1, or 1 where nothing was hit.
HWY_ATTR void recall_openness(const scene::PointGrids& grids, const RayHits& hits,
                              float* openness) {
    const Vf part = splat(1.0f / 65535.0f), one = splat(1.0f);
    for (uint32_t i = 0; i < hits.count; i += kLanes) {
        const GridPlaces places(grids, hits, i);
        Vf open = hn::Zero(kF);
        for (int k = 0; k < 3; ++k) {
            const Vu value = hn::GatherIndex(kU, grids.values.data(), places.index[k]);
            open =
                hn::Add(open, hn::Mul(places.weight[k], hn::ConvertTo(kF, hn::BitCast(kI, value))));
        }
        const auto missed = hn::RebindMask(
            kF, hn::Eq(hn::LoadU(kU, hits.triangle + i), hn::Set(kU, geometry::kNoTriangle)));
        const Vf other = hn::IfThenElse(missed, one, splat(-1.0f));
        const Vf value = hn::Min(hn::Mul(open, part), one);
        hn::StoreU(hn::IfThenElse(places.known, value, other), kF, openness + i);
    }
}

// A channel of scene::SharedExponent.
template <int Shift>
HWY_INLINE Vf channel_of(Vu bits) {
    using scene::SharedExponent;
    const Vu mantissa = hn::And(hn::ShiftRight<Shift>(bits), hn::Set(kU, SharedExponent::kMost));
    return hn::ConvertTo(kF, hn::BitCast(kI, mantissa));
}

// Where nothing is known it is black.
HWY_ATTR void recall_bounced(const scene::PointGrids& grids, const RayHits& hits,
                             float* const bounced[3]) {
    using scene::SharedExponent;
    constexpr int kBits = SharedExponent::kBits;
    const auto bias = hn::Set(kU, uint32_t(127 - SharedExponent::kBias - kBits));
    for (uint32_t i = 0; i < hits.count; i += kLanes) {
        const GridPlaces places(grids, hits, i);
        V3 light = splat(math::Vec3(0));
        for (int k = 0; k < 3; ++k) {
            const Vu bits = hn::GatherIndex(kU, grids.values.data(), places.index[k]);
            const Vu exponent = hn::Add(hn::ShiftRight<3 * kBits>(bits), bias);
            const Vf unit = hn::BitCast(kF, hn::ShiftLeft<23>(exponent));
            const Vf weight = hn::Mul(places.weight[k], unit);
            light = add(light, scale(V3{channel_of<0>(bits), channel_of<kBits>(bits),
                                        channel_of<2 * kBits>(bits)},
                                     weight));
        }
        hn::StoreU(hn::IfThenElseZero(places.known, light.x), kF, bounced[0] + i);
        hn::StoreU(hn::IfThenElseZero(places.known, light.y), kF, bounced[1] + i);
        hn::StoreU(hn::IfThenElseZero(places.known, light.z), kF, bounced[2] + i);
    }
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
