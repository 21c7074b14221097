// Triangles as a beam of parallel rays sees them. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_PARALLEL_FACET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_PARALLEL_FACET_INL_H
#undef PEREGRINE_TRACE_BVH_PARALLEL_FACET_INL_H
#else
#define PEREGRINE_TRACE_BVH_PARALLEL_FACET_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "simd/lanes-inl.h"
#include "trace/bvh/parallel/parallel-inl.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

using accel::bvh::Block;

// With D, Dv, Do of ParallelBeam for one triangle, and S the larger side of its window: rays
// outside the window miss (the margin of ParallelBeam), and to a ray inside every vertex is closer
// than S.
//
// The edge function from vertex i to j is U(p, q) = c + a p + b q, a = yi - yj, b = xj - xi,
// c = -(a xi + b yi). Sheared vertices relative to a ray are off by 5 D here and in the canonical
// test: 4 * 10 D S in U and, as S is at least 64 D, 4 D S for products of errors. Rounding a and b
// adds 2 S S, at most 8 D S; c adds 8 S Dv, a p + b q + c adds 5 S * 2 Do + 4 S * 2 Dv. The sum is
// 70 D S. Beyond
//     tolerance = 2^-17 D S,
// which is 128 D S, a function has the sign of the canonical one for rays in the window. A ray
// outside is beyond one of the lines, so that function is not above the tolerance: that counts
// rounding alone. U + V + W = det, computed as b0 a1 - a0 b1, is off by 3 * 44 D S + 8 S S: where
// it is above 4 tolerances, the canonical one is positive, and no hit has all its functions
// negative.
//
// Depth: let h = z + a x + b y for any a and b, L = 1 + |a| + |b|. The triangle's point P of a hit
// has h within the range of h at the vertices. Hence, give or take the error, so has z + a p + b q
// of the hit's z: across, P and the foot are 17.3 D + 5 Do apart and vertices off by 5 Dv, along
// it 8.1 D, Dv and, of the limit, 4 Do. Rounding adds 6 D (L - 1) + 2 Dv: less than 29 D L in all,
// and
//     margin L = 2^-19 D L
// is taken. a and b are those of the plane where they are known, so the range is as small as
// errors.
struct ParallelFacets : Facets {
    // Returns the triangles that rays in `window` may hit up to the z of `limit`.
    HWY_ATTR uint32_t project(const ParallelBeam& beam, const Block& block, const Window& window,
                              float limit);

private:
    struct Corners {
        V4 x[3], y[3], z[3];
        V4 reach; // D
    };
    HWY_ATTR static Corners corners_of(const ParallelBeam& beam, const Block& block);
    HWY_ATTR void find_edges(const Corners& corners, V4 size);
    HWY_ATTR void find_planes(const Corners& corners, const V4 (&ea)[3], const V4 (&eb)[3], V4 det,
                              M4 sure);
};

inline HWY_ATTR ParallelFacets::Corners ParallelFacets::corners_of(const ParallelBeam& beam,
                                                                   const Block& block) {
    const V4 cx = hn::Set(k4, beam.center[0]), cy = hn::Set(k4, beam.center[1]),
             cz = hn::Set(k4, beam.center[2]);
    const V4 sx = hn::Set(k4, beam.sx), sy = hn::Set(k4, beam.sy), turn = hn::Set(k4, beam.turn);
    Corners corners;
    // 2^-100 stands for what is lost in the denormal range.
    V4 reach = hn::Set(k4, 0x1p-100f);
    for (int i = 0; i < 3; ++i) {
        const V4 x = hn::Sub(hn::Load(k4, block.vertex[i][beam.kx]), cx);
        const V4 y = hn::Sub(hn::Load(k4, block.vertex[i][beam.ky]), cy);
        const V4 z = hn::Sub(hn::Load(k4, block.vertex[i][beam.kz]), cz);
        reach = hn::Max(reach, hn::Max(hn::Abs(x), hn::Max(hn::Abs(y), hn::Abs(z))));
        corners.x[i] = hn::NegMulAdd(sx, z, x);
        corners.y[i] = hn::NegMulAdd(sy, z, y);
        corners.z[i] = hn::Mul(z, turn);
    }
    corners.reach = hn::Add(reach, hn::Set(k4, beam.reach));
    return corners;
}

// `size`: S.
inline HWY_ATTR void ParallelFacets::find_edges(const Corners& corners, V4 size) {
    // U from vertices 2 and 1, V from 0 and 2, W from 1 and 0.
    constexpr int kFrom[3] = {2, 0, 1}, kTo[3] = {1, 2, 0};
    const V4(&x)[3] = corners.x, (&y)[3] = corners.y;
    const V4 e = hn::Mul(hn::Set(k4, 0x1p-17f), hn::Mul(corners.reach, size));
    V4 ea[3], eb[3];
    for (int edge = 0; edge < 3; ++edge) {
        const int i = kFrom[edge], j = kTo[edge];
        ea[edge] = hn::Sub(y[i], y[j]);
        eb[edge] = hn::Sub(x[j], x[i]);
    }
    const V4 det = hn::NegMulAdd(ea[0], eb[1], hn::Mul(eb[0], ea[1]));
    // Where products of three lengths fit float with room to spare.
    const auto fits = hn::And(hn::Gt(e, hn::Set(k4, 0x1p-80f)), hn::Lt(e, hn::Set(k4, 0x1p80f)));
    const auto sure = hn::And(fits, hn::Gt(hn::Abs(det), hn::Mul(hn::Set(k4, 4.0f), e)));
    by_window = ~bits_of(k4, sure) & 15u;
    find_planes(corners, ea, eb, det, sure);
    hn::Store(e, k4, tolerance);
    for (int edge = 0; edge < 3; ++edge) {
        const int i = kFrom[edge];
        const V4 ta = hn::CopySignToAbs(hn::Abs(ea[edge]), hn::Xor(ea[edge], det));
        const V4 tb = hn::CopySignToAbs(hn::Abs(eb[edge]), hn::Xor(eb[edge], det));
        hn::Store(ta, k4, a[edge]);
        hn::Store(tb, k4, b[edge]);
        hn::Store(hn::Neg(hn::MulAdd(ta, x[i], hn::Mul(tb, y[i]))), k4, c[edge]);
    }
}

inline HWY_ATTR void ParallelFacets::find_planes(const Corners& corners, const V4 (&ea)[3],
                                                 const V4 (&eb)[3], V4 det, M4 sure) {
    const V4(&z)[3] = corners.z;
    const V4 scale = hn::Div(hn::Set(k4, -1.0f), det);
    // a0 + a1 + a2 = 0: differences of z lose less.
    const V4 z1 = hn::Sub(z[1], z[0]), z2 = hn::Sub(z[2], z[0]);
    V4 pa = hn::Mul(scale, hn::MulAdd(ea[1], z1, hn::Mul(ea[2], z2)));
    V4 pb = hn::Mul(scale, hn::MulAdd(eb[1], z1, hn::Mul(eb[2], z2)));
    const V4 steep = hn::Add(hn::Abs(pa), hn::Abs(pb));
    const auto known = hn::And(sure, hn::Lt(steep, hn::Set(k4, 0x1p20f)));
    pa = hn::IfThenElseZero(known, pa);
    pb = hn::IfThenElseZero(known, pb);
    const auto at = [&](int i) HWY_ATTR __attribute__((always_inline)) {
        return hn::MulAdd(corners.x[i], pa, hn::MulAdd(corners.y[i], pb, z[i]));
    };
    const V4 h0 = at(0), h1 = at(1), h2 = at(2);
    const V4 l = hn::Add(hn::IfThenElseZero(known, steep), hn::Set(k4, 1.0f));
    const V4 error = hn::Mul(hn::Mul(hn::Set(k4, 0x1p-19f), corners.reach), l);
    hn::Store(pa, k4, plane_a);
    hn::Store(pb, k4, plane_b);
    hn::Store(hn::Sub(hn::Min(h0, hn::Min(h1, h2)), error), k4, least_h);
    hn::Store(hn::Add(hn::Max(h0, hn::Max(h1, h2)), error), k4, most_h);
}

inline HWY_ATTR uint32_t ParallelFacets::project(const ParallelBeam& beam, const Block& block,
                                                 const Window& window, float limit) {
    const Corners corners = corners_of(beam, block);
    const V4(&x)[3] = corners.x, (&y)[3] = corners.y, (&z)[3] = corners.z;
    const V4 margin = hn::Mul(hn::Set(k4, 0x1p-19f), corners.reach);
    const V4 left = hn::Sub(hn::Min(x[0], hn::Min(x[1], x[2])), margin);
    const V4 right = hn::Add(hn::Max(x[0], hn::Max(x[1], x[2])), margin);
    const V4 bottom = hn::Sub(hn::Min(y[0], hn::Min(y[1], y[2])), margin);
    const V4 top = hn::Add(hn::Max(y[0], hn::Max(y[1], y[2])), margin);
    const V4 first_z = hn::Sub(hn::Min(z[0], hn::Min(z[1], z[2])), margin);
    const V4 last_z = hn::Add(hn::Max(z[0], hn::Max(z[1], z[2])), margin);
    const auto across =
        hn::And(hn::Le(left, hn::Set(k4, window.p1)), hn::Ge(right, hn::Set(k4, window.p0)));
    const auto down =
        hn::And(hn::Le(bottom, hn::Set(k4, window.q1)), hn::Ge(top, hn::Set(k4, window.q0)));
    const auto along =
        hn::And(hn::Le(first_z, hn::Set(k4, limit)), hn::Ge(last_z, hn::Set(k4, beam.near)));
    const uint32_t seen = bits_of(k4, hn::And(along, hn::And(across, down)));
    if (seen == 0) return 0;
    hn::Store(left, k4, p0);
    hn::Store(right, k4, p1);
    hn::Store(bottom, k4, q0);
    hn::Store(top, k4, q1);
    hn::Store(first_z, k4, nearest);
    find_edges(corners, hn::Max(hn::Sub(right, left), hn::Sub(top, bottom)));
    return seen;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
