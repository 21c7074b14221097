// geometry/intersect.h for a packet: the same operations in the same order, lane by lane.
#if defined(PEREGRINE_TRACE_INTERSECT_PACKET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_INTERSECT_PACKET_INL_H
#undef PEREGRINE_TRACE_INTERSECT_PACKET_INL_H
#else
#define PEREGRINE_TRACE_INTERSECT_PACKET_INL_H
#endif

#include <hwy/highway.h>

#include "geometry/triangle.h"
#include "trace/kernels.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Eight rays, or four. (Sixteen at a time double the work of packets whose rays part.)
using Df = hn::CappedTag<float, 8>;
using Dh = hn::Half<Df>;
using Dd = hn::Repartition<double, Df>;
using Du = hn::RebindToUnsigned<Df>;
constexpr Df kF;
constexpr Dh kH;
constexpr Dd kD;
constexpr Du kU;
constexpr size_t kLanes = hn::MaxLanes(kF);
using Vf = hn::Vec<Df>;
using Vh = hn::Vec<Dh>;
using Vd = hn::Vec<Dd>;
using Vu = hn::Vec<Du>;
using Mf = hn::Mask<Df>;

HWY_INLINE HWY_ATTR uint64_t lane_bits(Mf mask) {
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(kF, mask, bytes);
    uint64_t bits;
    __builtin_memcpy(&bits, bytes, sizeof bits);
    return bits;
}

// The parts of the test that depend on the rays alone; all lanes share the dominant axis.
struct ShearedPacket {
    int kx, ky, kz;
    Vf ox, oy, oz;
    Vf sx, sy, dz;

    HWY_ATTR ShearedPacket(const Vf (&origin)[3], const Vf (&direction)[3], int axis) {
        kz = axis;
        kx = kz == 2 ? 0 : kz + 1;
        ky = kx == 2 ? 0 : kx + 1;
        ox = origin[kx];
        oy = origin[ky];
        oz = origin[kz];
        dz = direction[kz];
        sx = hn::Div(direction[kx], dz);
        sy = hn::Div(direction[ky], dz);
    }
};

struct PacketHit {
    Mf lanes;
    Vf t, u, v;
    Vf back; // 1 or 0 as integer bits
};

// Steps 4 to 6 in double, for one half of the lanes. A lane without a hit gets t = NaN.
struct Precise {
    Vh t, u, v, facing;
};
HWY_INLINE HWY_ATTR Precise intersect_half(Vd ax, Vd ay, Vd az, Vd bx, Vd by, Vd bz, Vd cx, Vd cy,
                                           Vd cz, Vd dz) {
    const Vd u = hn::Sub(hn::Mul(cx, by), hn::Mul(cy, bx));
    const Vd v = hn::Sub(hn::Mul(ax, cy), hn::Mul(ay, cx));
    const Vd w = hn::Sub(hn::Mul(bx, ay), hn::Mul(by, ax));
    const Vd zero = hn::Zero(kD);
    const auto outside =
        hn::And(hn::Lt(hn::Min(u, hn::Min(v, w)), zero), hn::Gt(hn::Max(u, hn::Max(v, w)), zero));
    const Vd det = hn::Add(hn::Add(u, v), w);
    const auto missed = hn::Or(outside, hn::Eq(det, zero));
    const Vd depth = hn::Add(hn::Add(hn::Mul(u, az), hn::Mul(v, bz)), hn::Mul(w, cz));
    const Vd r = hn::Div(hn::Set(kD, 1.0), hn::Mul(det, dz));
    const Vd t = hn::Mul(depth, r);
    const Vd nan = hn::Set(kD, std::numeric_limits<double>::quiet_NaN());
    const Vd facing = hn::CopySign(hn::Set(kD, 1.0), hn::Xor(det, dz));
    return {hn::DemoteTo(kH, hn::IfThenElse(missed, nan, t)),
            hn::DemoteTo(kH, hn::Mul(hn::Mul(v, dz), r)),
            hn::DemoteTo(kH, hn::Mul(hn::Mul(w, dz), r)), hn::DemoteTo(kH, facing)};
}

// A triangle's corners relative to each ray.
struct ShearedTriangle {
    Vf ax, ay, az, bx, by, bz, cx, cy, cz;

    // Lanes that the exact edge functions cannot reject for their signs.
    HWY_INLINE HWY_ATTR Mf maybe() const {
        const Vf u = hn::Sub(hn::Mul(cx, by), hn::Mul(cy, bx));
        const Vf v = hn::Sub(hn::Mul(ax, cy), hn::Mul(ay, cx));
        const Vf w = hn::Sub(hn::Mul(bx, ay), hn::Mul(by, ax));
        const Vf zero = hn::Zero(kF);
        return hn::Not(hn::And(hn::Lt(hn::Min(u, hn::Min(v, w)), zero),
                               hn::Gt(hn::Max(u, hn::Max(v, w)), zero)));
    }
};

// The lanes of `maybe` that are hit within [t_min, t_max]; false if there are none.
HWY_INLINE HWY_ATTR bool decide(const ShearedTriangle& s, Vf dz, Mf maybe, Vf t_min, Vf t_max,
                                PacketHit& hit) {
    const auto low = [](Vf x) HWY_ATTR { return hn::PromoteTo(kD, hn::LowerHalf(kH, x)); };
    const auto high = [](Vf x) HWY_ATTR { return hn::PromoteTo(kD, hn::UpperHalf(kH, x)); };
    const Precise a = intersect_half(low(s.ax), low(s.ay), low(s.az), low(s.bx), low(s.by),
                                     low(s.bz), low(s.cx), low(s.cy), low(s.cz), low(dz));
    const Precise b = intersect_half(high(s.ax), high(s.ay), high(s.az), high(s.bx), high(s.by),
                                     high(s.bz), high(s.cx), high(s.cy), high(s.cz), high(dz));
    hit.t = hn::Combine(kF, b.t, a.t);
    const Vf largest = hn::Set(kF, std::numeric_limits<float>::max());
    hit.lanes = hn::And(maybe, hn::And(hn::Ge(hit.t, t_min),
                                       hn::And(hn::Le(hit.t, t_max), hn::Le(hit.t, largest))));
    if (hn::AllFalse(kF, hit.lanes)) return false;
    hit.u = hn::Combine(kF, b.u, a.u);
    hit.v = hn::Combine(kF, b.v, a.v);
    const Vf facing = hn::Combine(kF, b.facing, a.facing);
    hit.back = hn::BitCast(
        kF, hn::IfThenElseZero(hn::RebindMask(kU, hn::Lt(facing, hn::Zero(kF))), hn::Set(kU, 1)));
    return true;
}

// The lanes of `active` that the triangle is hit by within [t_min, t_max]; false if there are none.
HWY_INLINE HWY_ATTR bool intersect(const ShearedPacket& ray, const geometry::Triangle& triangle,
                                   Mf active, Vf t_min, Vf t_max, PacketHit& hit) {
    const auto shear = [&](const geometry::Vec3& p, Vf& x, Vf& y, Vf& z) HWY_ATTR {
        z = hn::Sub(hn::Set(kF, p[ray.kz]), ray.oz);
        x = hn::Sub(hn::Sub(hn::Set(kF, p[ray.kx]), ray.ox), hn::Mul(ray.sx, z));
        y = hn::Sub(hn::Sub(hn::Set(kF, p[ray.ky]), ray.oy), hn::Mul(ray.sy, z));
    };
    ShearedTriangle s;
    shear(triangle.v0, s.ax, s.ay, s.az);
    shear(triangle.v1, s.bx, s.by, s.bz);
    shear(triangle.v2, s.cx, s.cy, s.cz);
    const Mf maybe = hn::And(s.maybe(), active);
    return !hn::AllFalse(kF, maybe) && decide(s, ray.dz, maybe, t_min, t_max, hit);
}

// The lanes of `lanes` whose hit is on a present part of a masked surface.
HWY_INLINE HWY_ATTR Mf present(Mf lanes, const AlphaTest& alpha,
                               const geometry::TriangleInfo& triangle, const PacketHit& hit) {
    alignas(64) float u[kLanes], v[kLanes], kept[kLanes];
    hn::Store(hit.u, kF, u);
    hn::Store(hit.v, kF, v);
    const uint64_t bits = lane_bits(lanes);
    for (size_t i = 0; i < kLanes; ++i) {
        const bool keep = (bits >> i & 1) && alpha.present(alpha.context, triangle, u[i], v[i]);
        kept[i] = keep ? 1.0f : 0.0f;
    }
    return hn::Gt(hn::Load(kF, kept), hn::Zero(kF));
}

// The lanes of `lanes` whose hit the filter accepts: Filter::accepts, lane by lane.
HWY_INLINE HWY_ATTR Mf accepted(Mf lanes, const Filter& filter,
                                const geometry::TriangleInfo& triangle, const PacketHit& hit) {
    if (!filter.sees_mesh(triangle)) return hn::FirstN(kF, 0);
    const Mf back = hn::RebindMask(kF, hn::Ne(hn::BitCast(kU, hit.back), hn::Zero(kU)));
    if (!filter.sees_back(triangle)) lanes = hn::AndNot(back, lanes);
    if (!filter.sees_front()) lanes = hn::And(back, lanes);
    if (filter.asks_alpha(triangle)) lanes = present(lanes, filter.alpha, triangle, hit);
    return lanes;
}

} // namespace peregrine::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
