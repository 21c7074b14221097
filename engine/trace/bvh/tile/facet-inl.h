// Triangles as a tile sees them. Included once for each instruction set, where a vector has eight
// floats.
#if defined(PEREGRINE_TRACE_BVH_TILE_FACET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_TILE_FACET_INL_H
#undef PEREGRINE_TRACE_BVH_TILE_FACET_INL_H
#else
#define PEREGRINE_TRACE_BVH_TILE_FACET_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "simd/lanes-inl.h"
#include "trace/bvh/tile/tile-inl.h"

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

using accel::bvh::Block;

// With vertices V0, V1, V2 in the tile's frame, X, Y, Z the largest |coordinates| and D as there,
// e = 2^-24:
//
// *Edges.* E(p, q) = (p, q, 1) . (Vi x Vj) = c + a p + b q has the sign of the canonical edge
// function, of which it is det(R, D, C) / d_kz times as much. It is the product of two vectors
// across the ray, (X - p Z, Y - q Z), at most W = |R| (X + Z) + |D| (Y + Z) long in the world. The
// canonical functions are off by 24 D 2 W e, which makes 48 D W; that the ray is rounded makes, by
// a triple product, (48 D + 72 W) W; both times S / |det|. The rounding of V, 5 D m, makes 10 D
// ((X + Z) (my + mz) + (Y + Z) (mx + mz)); that of a, b, c and the sums 13 (Y Z + X Z + X Y), for
// which 16 are taken. Below the sum of these, negated, a ray is missed; beyond it the ray is inside
// for certain.
//
// *Plane.* N(p, q) = the sum of the three, and t N = h = V0 . (the sum of Vi x Vj) in the plane. At
// a hit t N differs from h by |N_a| tx + |N_b| ty + |N_c| tz at most, t being m (15 + 4.5 k) D, of
// which (8.2 + 4.1 k) D are the hit's (tile-inl.h) and 6 D the vertices'. N is off by 64 (Y Z + X Z
// + X Y), h by 128 X Y Z. So a ray is missed if the N that it may have at most is too little for t
// at its limit. The sign of h says which side is seen, and so which sign E has: a hit of the other
// sign has all three E within the tolerance, hence N within three times that, and t beyond all
// vertices if h is large.
//
// *Window.* A triangle that is ahead is seen within the window of its vertices, moved by (tx + tz)
// / Z and what a division loses.
struct TileFacets {
    alignas(16) float a[3][4], b[3][4], c[3][4]; // of edges, inside positive, tolerance added
    alignas(16) float sure[4]; // of a, b, c beyond which a ray is inside for certain
    alignas(16) float det_a[4], det_b[4], det_c[4]; // of planes likewise
    alignas(16) float height[4];                    // h, less what it may be off by
    alignas(16) float vertex[3][3][4]; // as the canonical test has them: vertex, axis, triangle
    alignas(16) int32_t x0[4], x1[4], y0[4], y1[4]; // pixels, inclusive
    uint32_t certain; // bits: triangles of which edges and planes tell something
    uint32_t back;    // ... seen from behind

    // Returns the triangles that rays of the tile may hit up to `limit`.
    HWY_ATTR uint32_t project(const Tile& tile, const Block& block, float limit);

private:
    struct Frame {
        V4 x[3], y[3], z[3];
        V4 most_x, most_y, most_z, least_z, reach;
    };
    HWY_INLINE HWY_ATTR Frame to_frame(const Tile& tile, const Block& block);
    HWY_INLINE HWY_ATTR uint32_t find_windows(const Frame& v, V4 tx, V4 ty, V4 tz);
    HWY_INLINE HWY_ATTR V4 edge_tolerance(const Tile& tile, const Frame& v) const;
};

HWY_INLINE HWY_ATTR TileFacets::Frame TileFacets::to_frame(const Tile& tile, const Block& block) {
    Frame v;
    v.most_x = v.most_y = v.most_z = v.reach = hn::Zero(k4);
    v.least_z = hn::Set(k4, std::numeric_limits<float>::infinity());
    for (int i = 0; i < 3; ++i) {
        V4 world[3];
        for (int k = 0; k < 3; ++k) {
            world[k] =
                hn::Sub(hn::Load(k4, block.vertex[i][k]), hn::Set(k4, float(tile.origin[k])));
            v.reach = hn::Max(v.reach, hn::Abs(world[k]));
        }
        hn::Store(world[tile.kx], k4, vertex[i][0]);
        hn::Store(world[tile.ky], k4, vertex[i][1]);
        hn::Store(world[tile.kz], k4, vertex[i][2]);
        const auto along = [&](int row) HWY_ATTR __attribute__((always_inline)) {
            return hn::MulAdd(world[0], hn::Set(k4, tile.row[row][0]),
                              hn::MulAdd(world[1], hn::Set(k4, tile.row[row][1]),
                                         hn::Mul(world[2], hn::Set(k4, tile.row[row][2]))));
        };
        v.x[i] = along(0);
        v.y[i] = along(1);
        v.z[i] = along(2);
        v.most_x = hn::Max(v.most_x, hn::Abs(v.x[i]));
        v.most_y = hn::Max(v.most_y, hn::Abs(v.y[i]));
        v.most_z = hn::Max(v.most_z, hn::Abs(v.z[i]));
        v.least_z = hn::Min(v.least_z, v.z[i]);
    }
    return v;
}

// Returns those with a pixel in it.
HWY_INLINE HWY_ATTR uint32_t TileFacets::find_windows(const Frame& v, V4 tx, V4 ty, V4 tz) {
    const V4 infinity = hn::Set(k4, std::numeric_limits<float>::infinity());
    V4 low_p = infinity, high_p = hn::Neg(infinity), low_q = infinity, high_q = hn::Neg(infinity);
    for (int i = 0; i < 3; ++i) {
        const V4 inverse = hn::Div(hn::Set(k4, 1.0f), v.z[i]);
        const V4 p = hn::Mul(v.x[i], inverse), q = hn::Mul(v.y[i], inverse);
        low_p = hn::Min(low_p, p);
        high_p = hn::Max(high_p, p);
        low_q = hn::Min(low_q, q);
        high_q = hn::Max(high_q, q);
    }
    const V4 two = hn::Set(k4, 2.0f);
    const auto ahead = hn::Gt(v.least_z, hn::Mul(two, tz));
    const V4 scale = hn::Div(two, v.least_z);
    const V4 rounding = hn::Set(k4, 0x1p-20f);
    const V4 margin_p = hn::MulAdd(hn::Add(tx, tz), scale, rounding);
    const V4 margin_q = hn::MulAdd(hn::Add(ty, tz), scale, rounding);
    const hn::RebindToSigned<D4> i4;
    const V4 sixteen = hn::Set(k4, 16.0f), middle = hn::Set(k4, 15.5f);
    const V4 before = hn::Set(k4, 0.0f), behind = hn::Set(k4, 31.0f);
    const V4 none_low = hn::Set(k4, 32.0f), none_high = hn::Set(k4, -1.0f);
    const auto from = [&](V4 low, V4 margin) HWY_ATTR __attribute__((always_inline)) {
        const V4 pixel = hn::Ceil(hn::MulAdd(hn::Sub(low, margin), sixteen, middle));
        return hn::ConvertTo(
            i4, hn::IfThenElse(ahead, hn::Min(hn::Max(pixel, before), none_low), before));
    };
    const auto to = [&](V4 high, V4 margin) HWY_ATTR __attribute__((always_inline)) {
        const V4 pixel = hn::Floor(hn::MulAdd(hn::Add(high, margin), sixteen, middle));
        return hn::ConvertTo(
            i4, hn::IfThenElse(ahead, hn::Max(hn::Min(pixel, behind), none_high), behind));
    };
    const auto left = from(low_p, margin_p), top = from(low_q, margin_q);
    const auto right = to(high_p, margin_p), bottom = to(high_q, margin_q);
    hn::Store(left, i4, x0);
    hn::Store(right, i4, x1);
    hn::Store(top, i4, y0);
    hn::Store(bottom, i4, y1);
    return ~bits_of(i4, hn::Or(hn::Gt(left, right), hn::Gt(top, bottom))) & 15u;
}

HWY_INLINE HWY_ATTR V4 TileFacets::edge_tolerance(const Tile& tile, const Frame& v) const {
    const V4 xz = hn::Add(v.most_x, v.most_z), yz = hn::Add(v.most_y, v.most_z);
    const V4 wide =
        hn::MulAdd(hn::Set(k4, tile.across[0]), xz, hn::Mul(hn::Set(k4, tile.across[1]), yz));
    const V4 canonical =
        hn::Mul(hn::Mul(hn::Set(k4, tile.direction), wide),
                hn::MulAdd(hn::Set(k4, 96.0f), v.reach, hn::Mul(hn::Set(k4, 72.0f), wide)));
    const V4 frame = hn::Mul(
        v.reach, hn::MulAdd(xz, hn::Set(k4, 10.0f * (tile.size[1] + tile.size[2])),
                            hn::Mul(yz, hn::Set(k4, 10.0f * (tile.size[0] + tile.size[2])))));
    return hn::MulAdd(hn::Set(k4, 0x1.02p-24f), hn::Add(canonical, frame), hn::Set(k4, 0x1p-100f));
}

inline HWY_ATTR uint32_t TileFacets::project(const Tile& tile, const Block& block, float limit) {
    const Frame v = to_frame(tile, block);
    const V4 drift = hn::Mul(v.reach, hn::Set(k4, tile.drift + 0x1.0p-24f * 15));
    const V4 tx = hn::Mul(drift, hn::Set(k4, tile.size[0]));
    const V4 ty = hn::Mul(drift, hn::Set(k4, tile.size[1]));
    const V4 tz = hn::Mul(drift, hn::Set(k4, tile.size[2]));
    uint32_t seen = find_windows(v, tx, ty, tz)
                    & bits_of(k4, hn::Le(hn::Sub(v.least_z, tz), hn::Set(k4, limit)));
    if (seen == 0) return 0;

    // U from vertices 1 and 2, V from 2 and 0, W from 0 and 1.
    constexpr int kFrom[3] = {1, 2, 0}, kTo[3] = {2, 0, 1};
    V4 ea[3], eb[3], ec[3];
    for (int edge = 0; edge < 3; ++edge) {
        const int i = kFrom[edge], j = kTo[edge];
        ea[edge] = hn::NegMulAdd(v.z[i], v.y[j], hn::Mul(v.y[i], v.z[j]));
        eb[edge] = hn::NegMulAdd(v.x[i], v.z[j], hn::Mul(v.z[i], v.x[j]));
        ec[edge] = hn::NegMulAdd(v.y[i], v.x[j], hn::Mul(v.x[i], v.y[j]));
    }
    const V4 da = hn::Add(ea[0], hn::Add(ea[1], ea[2]));
    const V4 db = hn::Add(eb[0], hn::Add(eb[1], eb[2]));
    const V4 dc = hn::Add(ec[0], hn::Add(ec[1], ec[2]));
    const V4 h = hn::MulAdd(da, v.x[0], hn::MulAdd(db, v.y[0], hn::Mul(dc, v.z[0])));

    const V4 e = hn::Set(k4, 0x1p-24f);
    const V4 areas = hn::MulAdd(v.most_x, v.most_y, hn::Mul(v.most_z, hn::Add(v.most_x, v.most_y)));
    const V4 rounding = hn::Mul(areas, e);
    const V4 tolerance = hn::MulAdd(rounding, hn::Set(k4, 16.0f), edge_tolerance(tile, v));
    const V4 det_tolerance = hn::MulAdd(rounding, hn::Set(k4, 64.0f), hn::Set(k4, 0x1p-100f));
    const V4 volume = hn::Mul(hn::Mul(v.most_x, v.most_y), hn::Mul(v.most_z, e));
    const V4 off =
        hn::MulAdd(hn::Abs(da), tx, hn::MulAdd(hn::Abs(db), ty, hn::Mul(hn::Abs(dc), tz)));
    const V4 h_tolerance = hn::MulAdd(
        off, hn::Set(k4, 1.01f), hn::MulAdd(volume, hn::Set(k4, 128.0f), hn::Set(k4, 0x1p-100f)));
    const V4 least_h = hn::Mul(hn::Sub(hn::Abs(h), h_tolerance), hn::Set(k4, 1.0f - 0x1p-20f));
    const V4 needed = hn::Mul(hn::Mul(hn::Set(k4, 4.04f), hn::Add(tolerance, det_tolerance)),
                              hn::Add(v.most_z, tz));
    certain = bits_of(k4, hn::Gt(least_h, needed)) & 15u;
    hn::Store(hn::Add(tolerance, tolerance), k4, sure);
    const V4 sign = hn::And(h, hn::Set(k4, -0.0f));
    back = bits_of(k4, hn::Gt(tile.mirrored ? hn::Neg(h) : h, hn::Zero(k4)));
    V4 most = hn::Set(k4, std::numeric_limits<float>::infinity());
    for (int edge = 0; edge < 3; ++edge) {
        const V4 ta = hn::Xor(ea[edge], sign), tb = hn::Xor(eb[edge], sign);
        const V4 tc = hn::Add(hn::Xor(ec[edge], sign), tolerance);
        hn::Store(ta, k4, a[edge]);
        hn::Store(tb, k4, b[edge]);
        hn::Store(tc, k4, c[edge]);
        most = hn::Min(most, hn::Add(tc, hn::Add(hn::Abs(ta), hn::Abs(tb))));
    }
    const V4 na = hn::Xor(da, sign), nb = hn::Xor(db, sign);
    const V4 nc = hn::Add(hn::Xor(dc, sign), det_tolerance);
    hn::Store(na, k4, det_a);
    hn::Store(nb, k4, det_b);
    hn::Store(nc, k4, det_c);
    hn::Store(least_h, k4, height);
    const V4 most_n = hn::Add(nc, hn::Add(hn::Abs(na), hn::Abs(nb)));
    const auto missed =
        hn::Or(hn::Lt(most, hn::Zero(k4)), hn::Lt(hn::Mul(most_n, hn::Set(k4, limit)), least_h));
    return seen & ~(bits_of(k4, missed) & certain);
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
