// Triangles as a beam sees them. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_FACET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_FACET_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_FACET_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_FACET_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "simd/lanes-inl.h"
#include "trace/bvh/beam/beam-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

using accel::bvh::Block;

// The edge functions of geometry/intersect.h are linear in the slopes of rays that share an origin:
//     U(dp, dq) = c + a dp + b dq,   (dp, dq) from the beam's centre,
// and so are V and W. Computed like this they are not exact. In units of e = 2^-24, with D the
// largest distance of a vertex from the origin along an axis and R the largest distance of a vertex
// from a ray of the beam, across: sheared vertices are off by 6 D, here and in the canonical test,
// which makes 24 D R in U there (64 D R where the ray's main axis is another one, slopes being at
// most 1.125), 24 D R + 6 R^2 in c, 12 D R + 6 R^2 each in a dp and b dq, 5 D R + 4 R^2 from the
// slopes' own rounding, 12 R^2 from adding up: 117 D R + 34 R^2. Beyond
//     tolerance = 2^-17 R (D + R)
// the sign is that of the canonical test; within, the canonical test decides.
//
// Depth is bounded by a plane h(x, y, z) = a x + b y + c z, x and y from the centre, which is about
// 1 at the vertices: with w = a dp + b dq + c, a hit at z has z w within the range of h at them,
// give or take
//     e (10 D K + (8 + 3 S) M L),   L = |a| + |b| + |c|,
// whatever a, b and c are. M is the largest distance of a vertex along an axis, from the centre for
// x and y; K = |a| (1 + |p|) + |b| (1 + |q|) + |c| for the centre (p, q), S the largest slope from
// it. Of this 8.1 D K are the theorem's of geometry/intersect.h, D K and M L the vertices', 3 M L
// those of h at them, (2 + 3 S) M L those of w. As long as h is positive at all vertices, a ray
// hits nothing where its limit times w is less, and where it is more, z is within the limit for
// certain.
//
// A triangle whose orientation is within the tolerance, because it is seen edge-on or is tiny, is
// judged by the window that it fills instead: by the theorem of geometry/intersect.h, hits are
// within 8.1 e D of it. The others' windows cut off what all three edges let through beyond the
// corners of small or thin triangles.
struct BeamFacets : Facets {
    alignas(16) float vertex[3][3][4]; // relative to the origin: vertex, axis (x, y, z), triangle

    // Returns the triangles that rays in `window` may hit up to the z of `limit`.
    HWY_ATTR uint32_t project(const Beam& beam, const Block& block, const Window& window,
                              float limit);

private:
    HWY_ATTR void find_planes(const Beam& beam, const V4 (&x)[3], const V4 (&y)[3],
                              const V4 (&z)[3], V4 most, V4 reach, float spread);
    HWY_ATTR uint32_t find_windows(const V4 (&x)[3], const V4 (&y)[3], const V4 (&z)[3], V4 least_z,
                                   V4 reach, const Window& window);
};

// Slopes from the beam's centre; everything for a triangle that is not ahead of the origin as a
// whole. Returns those that overlap `window`.
inline HWY_ATTR uint32_t BeamFacets::find_windows(const V4 (&x)[3], const V4 (&y)[3],
                                                  const V4 (&z)[3], V4 least_z, V4 reach,
                                                  const Window& window) {
    const V4 infinity = hn::Set(k4, std::numeric_limits<float>::infinity());
    V4 low_p = infinity, high_p = hn::Neg(infinity), low_q = infinity, high_q = hn::Neg(infinity);
    for (int i = 0; i < 3; ++i) {
        const V4 inverse = hn::Div(hn::Set(k4, 1.0f), z[i]);
        const V4 p = hn::Mul(x[i], inverse), q = hn::Mul(y[i], inverse);
        low_p = hn::Min(low_p, p);
        high_p = hn::Max(high_p, p);
        low_q = hn::Min(low_q, q);
        high_q = hn::Max(high_q, q);
    }
    const V4 margin = hn::Div(hn::Mul(hn::Set(k4, 0x1p-19f), reach), least_z);
    const auto ahead = hn::Gt(least_z, hn::Mul(hn::Set(k4, 0x1p-18f), reach));
    low_p = hn::IfThenElse(ahead, hn::Sub(low_p, margin), hn::Neg(infinity));
    low_q = hn::IfThenElse(ahead, hn::Sub(low_q, margin), hn::Neg(infinity));
    high_p = hn::IfThenElse(ahead, hn::Add(high_p, margin), infinity);
    high_q = hn::IfThenElse(ahead, hn::Add(high_q, margin), infinity);
    hn::Store(low_p, k4, p0);
    hn::Store(high_p, k4, p1);
    hn::Store(low_q, k4, q0);
    hn::Store(high_q, k4, q1);
    const auto across =
        hn::And(hn::Le(low_p, hn::Set(k4, window.p1)), hn::Ge(high_p, hn::Set(k4, window.p0)));
    const auto down =
        hn::And(hn::Le(low_q, hn::Set(k4, window.q1)), hn::Ge(high_q, hn::Set(k4, window.q0)));
    return bits_of(k4, hn::And(across, down));
}

// `most`: M; `reach`: D; `spread`: S.
inline HWY_ATTR void BeamFacets::find_planes(const Beam& beam, const V4 (&x)[3], const V4 (&y)[3],
                                             const V4 (&z)[3], V4 most, V4 reach, float spread) {
    const V4 x1 = hn::Sub(x[1], x[0]), y1 = hn::Sub(y[1], y[0]), z1 = hn::Sub(z[1], z[0]);
    const V4 x2 = hn::Sub(x[2], x[0]), y2 = hn::Sub(y[2], y[0]), z2 = hn::Sub(z[2], z[0]);
    const V4 nx = hn::NegMulAdd(z1, y2, hn::Mul(y1, z2));
    const V4 ny = hn::NegMulAdd(x1, z2, hn::Mul(z1, x2));
    const V4 nz = hn::NegMulAdd(y1, x2, hn::Mul(x1, y2));
    const V4 height = hn::MulAdd(nx, x[0], hn::MulAdd(ny, y[0], hn::Mul(nz, z[0])));
    const V4 one = hn::Set(k4, 1.0f), scale = hn::Div(one, height);
    const V4 pa = hn::Mul(nx, scale), pb = hn::Mul(ny, scale), pc = hn::Mul(nz, scale);
    const auto at = [&](int i) HWY_ATTR __attribute__((always_inline)) {
        return hn::MulAdd(pa, x[i], hn::MulAdd(pb, y[i], hn::Mul(pc, z[i])));
    };
    const V4 h0 = at(0), h1 = at(1), h2 = at(2);
    const V4 ab = hn::Add(hn::Abs(pa), hn::Abs(pb)), l = hn::Add(ab, hn::Abs(pc));
    const V4 k = hn::MulAdd(hn::Abs(pa), hn::Set(k4, std::abs(beam.center_p)),
                            hn::MulAdd(hn::Abs(pb), hn::Set(k4, std::abs(beam.center_q)), l));
    const V4 e = hn::MulAdd(hn::Mul(hn::Set(k4, 10 * 0x1p-24f), reach), k,
                            hn::Mul(hn::Mul(hn::Set(k4, (8 + 3 * spread) * 0x1p-24f), most), l));
    const V4 low = hn::Sub(hn::Min(h0, hn::Min(h1, h2)), e);
    const V4 high = hn::Add(hn::Max(h0, hn::Max(h1, h2)), e);
    const auto known = hn::And(hn::Gt(low, hn::Zero(k4)), hn::Lt(high, hn::Set(k4, 2.0f)));
    const V4 infinity = hn::Set(k4, std::numeric_limits<float>::infinity());
    hn::Store(hn::IfThenElseZero(known, pa), k4, plane_a);
    hn::Store(hn::IfThenElseZero(known, pb), k4, plane_b);
    hn::Store(hn::IfThenElse(known, pc, one), k4, plane_c);
    hn::Store(hn::IfThenElse(known, hn::Mul(low, hn::Set(k4, 1.0f - 0x1p-20f)), hn::Neg(infinity)),
              k4, least_h);
    hn::Store(hn::IfThenElse(known, hn::Mul(high, hn::Set(k4, 1.0f + 0x1p-20f)), infinity), k4,
              most_h);
}

inline HWY_ATTR uint32_t BeamFacets::project(const Beam& beam, const Block& block,
                                             const Window& window, float limit) {
    const V4 sign = hn::Set(k4, beam.sign);
    const V4 cp = hn::Set(k4, beam.center_p), cq = hn::Set(k4, beam.center_q);
    V4 x[3], y[3], z[3];
    V4 reach_across = hn::Zero(k4), reach_along = hn::Zero(k4), reach_uncentered = hn::Zero(k4);
    V4 least_z = hn::Set(k4, std::numeric_limits<float>::infinity());
    for (int i = 0; i < 3; ++i) {
        const V4 vx = hn::Sub(hn::Load(k4, block.vertex[i][beam.kx]), hn::Set(k4, beam.origin[0]));
        const V4 vy = hn::Sub(hn::Load(k4, block.vertex[i][beam.ky]), hn::Set(k4, beam.origin[1]));
        const V4 vz = hn::Sub(hn::Load(k4, block.vertex[i][beam.kz]), hn::Set(k4, beam.origin[2]));
        hn::Store(vx, k4, vertex[i][0]);
        hn::Store(vy, k4, vertex[i][1]);
        hn::Store(vz, k4, vertex[i][2]);
        z[i] = hn::Mul(vz, sign);
        x[i] = hn::NegMulAdd(cp, z[i], vx);
        y[i] = hn::NegMulAdd(cq, z[i], vy);
        reach_across = hn::Max(reach_across, hn::Max(hn::Abs(x[i]), hn::Abs(y[i])));
        reach_along = hn::Max(reach_along, hn::Abs(z[i]));
        reach_uncentered = hn::Max(reach_uncentered, hn::Max(hn::Abs(vx), hn::Abs(vy)));
        least_z = hn::Min(least_z, z[i]);
    }
    // t z is a mean of the vertices' z, rounded: 3 e.
    const V4 nearest_z = hn::Sub(least_z, hn::Mul(hn::Set(k4, 0x1p-20f), hn::Abs(least_z)));
    hn::Store(nearest_z, k4, nearest);
    const float spread = std::max(std::max(-beam.window.p0, beam.window.p1),
                                  std::max(-beam.window.q0, beam.window.q1));
    const V4 r = hn::MulAdd(hn::Set(k4, spread), reach_along, reach_across);
    const V4 d = hn::MulAdd(hn::Set(k4, 1.125f), reach_along, r);
    const V4 e =
        hn::MulAdd(hn::Mul(hn::Set(k4, 0x1p-17f), r), hn::Add(d, r), hn::Set(k4, 0x1p-140f));
    hn::Store(e, k4, tolerance);

    const V4 p0 = hn::Set(k4, window.p0), p1 = hn::Set(k4, window.p1);
    const V4 q0 = hn::Set(k4, window.q0), q1 = hn::Set(k4, window.q1);
    const auto highest = [&](V4 a, V4 b, V4 c) HWY_ATTR {
        return hn::Add(c, hn::Add(hn::Max(hn::Mul(a, p0), hn::Mul(a, p1)),
                                  hn::Max(hn::Mul(b, q0), hn::Mul(b, q1))));
    };
    const auto lowest = [&](V4 a, V4 b, V4 c) HWY_ATTR {
        return hn::Add(c, hn::Add(hn::Min(hn::Mul(a, p0), hn::Mul(a, p1)),
                                  hn::Min(hn::Mul(b, q0), hn::Mul(b, q1))));
    };
    V4 ea[3], eb[3], ec[3];
    // U from vertices 2 and 1, V from 0 and 2, W from 1 and 0.
    constexpr int kFrom[3] = {2, 0, 1}, kTo[3] = {1, 2, 0};
    for (int edge = 0; edge < 3; ++edge) {
        const int i = kFrom[edge], j = kTo[edge];
        ea[edge] = hn::NegMulAdd(z[i], y[j], hn::Mul(y[i], z[j]));
        eb[edge] = hn::NegMulAdd(x[i], z[j], hn::Mul(z[i], x[j]));
        ec[edge] = hn::NegMulAdd(y[i], x[j], hn::Mul(x[i], y[j]));
    }
    const V4 da = hn::Add(ea[0], hn::Add(ea[1], ea[2]));
    const V4 db = hn::Add(eb[0], hn::Add(eb[1], eb[2]));
    const V4 dc = hn::Add(ec[0], hn::Add(ec[1], ec[2]));
    const V4 e4 = hn::Mul(hn::Set(k4, 4.0f), e);
    // Where products of three lengths fit float with room to spare.
    const auto fits = hn::And(hn::Gt(e, hn::Set(k4, 0x1p-60f)), hn::Lt(e, hn::Set(k4, 0x1p60f)));
    const auto front = hn::And(fits, hn::Gt(lowest(da, db, dc), e4));
    const auto back = hn::And(fits, hn::Lt(highest(da, db, dc), hn::Neg(e4)));
    const V4 turn = hn::IfThenElse(back, hn::Set(k4, -1.0f), hn::Set(k4, 1.0f));
    V4 most = hn::Set(k4, std::numeric_limits<float>::infinity());
    for (int edge = 0; edge < 3; ++edge) {
        const V4 ta = hn::Mul(ea[edge], turn), tb = hn::Mul(eb[edge], turn),
                 tc = hn::Mul(ec[edge], turn);
        hn::Store(ta, k4, a[edge]);
        hn::Store(tb, k4, b[edge]);
        hn::Store(tc, k4, c[edge]);
        most = hn::Min(most, highest(ta, tb, tc));
    }
    find_planes(beam, x, y, z, hn::Max(reach_across, reach_along),
                hn::Max(reach_uncentered, reach_along), spread);
    by_window = ~bits_of(k4, hn::Or(front, back)) & 15u;
    const V4 most_w = highest(hn::Load(k4, plane_a), hn::Load(k4, plane_b), hn::Load(k4, plane_c));
    const auto beyond = hn::Lt(hn::Mul(most_w, hn::Set(k4, limit)), hn::Load(k4, least_h));
    const uint32_t near_enough =
        bits_of(k4, hn::AndNot(beyond, hn::Le(nearest_z, hn::Set(k4, limit))));
    const uint32_t seen = bits_of(k4, hn::Ge(most, hn::Neg(e))) | by_window;
    if ((seen & near_enough) == 0) return 0;
    return seen & near_enough & find_windows(x, y, z, least_z, d, window);
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
