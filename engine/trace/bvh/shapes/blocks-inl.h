// Shapes against four triangles at a time, in float: a filter in front of the canonical tests.
// Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_SHAPES_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_SHAPES_BLOCKS_INL_H
#undef PEREGRINE_TRACE_BVH_SHAPES_BLOCKS_INL_H
#else
#define PEREGRINE_TRACE_BVH_SHAPES_BLOCKS_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "simd/lanes-inl.h"
#include "simd/vectors-inl.h"
#include "trace/shapes/volume.h"

#include <algorithm>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;
using accel::bvh::Block;

// Three coordinates of four points.
using Vec4 = Vec3<V4>;

HWY_INLINE HWY_ATTR Vec4 splat(const math::Vec3d& v) {
    return {hn::Set(k4, float(v.x)), hn::Set(k4, float(v.y)), hn::Set(k4, float(v.z))};
}
// At least the length: what a square loses in the denormal range is put in front.
HWY_INLINE HWY_ATTR V4 length(const Vec4& v) {
    return hn::Sqrt(hn::Add(dot(v, v), hn::Set(k4, 0x1p-130f)));
}

struct FourTriangles {
    Vec4 a, b, c;    // relative to an origin
    Vec4 ab, ac, bc; // exact but for one rounding each
    V4 size;         // the largest component of an edge

    HWY_INLINE HWY_ATTR FourTriangles(const Block& block, const Vec4& origin) {
        const auto vertex = [&](int i) HWY_ATTR __attribute__((always_inline)) {
            return Vec4{hn::Load(k4, block.vertex[i][0]), hn::Load(k4, block.vertex[i][1]),
                        hn::Load(k4, block.vertex[i][2])};
        };
        const Vec4 v0 = vertex(0), v1 = vertex(1), v2 = vertex(2);
        ab = v1 - v0;
        ac = v2 - v0;
        bc = v2 - v1;
        a = v0 - origin;
        b = v1 - origin;
        c = v2 - origin;
        size = hn::Max(largest(ab), largest(ac)); // of bc: at most twice that
    }
};

// A moving sphere or capsule, by separating axes: those of the world, the planes of the triangles,
// the directions across the path and an edge, and the path itself. An axis that keeps triangle and
// swept volume apart by more than the error proves that there is no contact. The plane also tells
// when at the earliest there is one, and for shapes that fall on a face when at the latest.
//
// With S the size of a triangle's edges, R = reach >= the largest component of a vertex relative to
// the origin plus the shape's extent, and a path that is cut to length 2 R along each axis (at a
// contact it is below R), e = 2^-24: a component of
// ab x ac is at most 2 S S and off by 8 e S S, so the height of the plane is off by 60 e S S R,
// what the path rises by 120 e S S R, what the axis does by 60 e S S R. Across an edge, which is 2
// S or less, it is 220 e |d| S R, with |d| the largest component. The canonical test's own error, 3
// * 2^-20 R in the distance, makes 3 * 2^-20 * 6 of the same units. The sums are below 2^-14 S S R
// and 2^-14 |d| S R, and below 2^-17 |d| R for the path itself; for the axes of the world see
// volume.h. 2^-100 is for what is lost in the denormal range.
class SweepFilter {
public:
    static constexpr float kPlaneError = 0x1p-14f;

    HWY_INLINE HWY_ATTR explicit SweepFilter(const Volume& volume) {
        const math::Vec3d &d = volume.direction, &axis = volume.axis;
        origin_ = splat(volume.origin);
        direction_ = splat(d);
        axis_ = splat(axis);
        const double speed = largest_component(d);
        const double length = std::sqrt(glm::dot(d, d));
        longest_ = hn::Set(k4, float(2 / speed));
        length12_ = hn::Set(k4, float(12 * length));
        radius_ = hn::Set(k4, float(volume.radius) * (1 + 0x1p-20f));
        extents_ = splat(volume.extent * (1 + 0x1p-20));
        const double smallest = 0x1p-26 * speed;
        math::Vec3d inverse;
        for (int k = 0; k < 3; ++k)
            inverse[k] = 1 / (std::fabs(d[k]) < smallest ? std::copysign(smallest, d[k]) : d[k]);
        inverse_ = splat(inverse);
        extent_ = hn::Set(k4, float(largest_component(volume.extent)) * (1 + 0x1p-20f));
        side_error_ = hn::Set(k4, float(0x1p-14 * speed));
        along_ = hn::Set(k4, float(volume.radius * length + std::fabs(glm::dot(d, axis)))
                                 * (1 + 0x1p-20f));
        along_error_ = hn::Set(k4, float(0x1p-17 * speed));
        square_ = hn::Set(k4, float(length * length) * (1 + 0x1p-20f));
        inverse_square_ = hn::Set(k4, float(1 / (length * length)) * (1 - 0x1p-20f));
        is_capsule_ = axis != math::Vec3d(0);
    }

    // What there is to know of a block: which triangles may be touched up to t_max, from when on at
    // the earliest, and which of them are touched for sure, by when.
    struct Findings {
        uint32_t open = 0, certain = 0; // bits
        alignas(16) float earliest[4];
        alignas(16) float latest[4]; // of the certain ones
    };

    HWY_INLINE HWY_ATTR void look(const Block& block, float t_max, Findings& found) const {
        const FourTriangles t(block, origin_);
        found.open = found.certain = 0;
        const V4 reach = hn::Add(hn::Add(largest(t.a), t.size), extent_);
        const V4 end = hn::Min(hn::Set(k4, t_max), hn::Mul(reach, longest_));

        const V4 wider = hn::Mul(hn::Set(k4, 0x1p-17f), reach);
        V4 enter = hn::Zero(k4), leave = end;
        meet_slab(t.a.x, t.b.x, t.c.x, hn::Add(extents_.x, wider), inverse_.x, enter, leave);
        meet_slab(t.a.y, t.b.y, t.c.y, hn::Add(extents_.y, wider), inverse_.y, enter, leave);
        meet_slab(t.a.z, t.b.z, t.c.z, hn::Add(extents_.z, wider), inverse_.z, enter, leave);
        auto apart = hn::Gt(enter, leave);
        if (bits_of(k4, apart) == 15) return;

        const V4 a = dot(t.a, direction_), b = dot(t.b, direction_), c = dot(t.c, direction_);
        const V4 along = hn::MulAdd(along_error_, reach, along_);
        const V4 first = hn::Min(a, hn::Min(b, c)), last = hn::Max(a, hn::Max(b, c));
        apart = hn::Or(apart, hn::Or(hn::Lt(last, hn::Neg(along)),
                                     hn::Gt(first, hn::MulAdd(end, square_, along))));

        const Vec4 normal = cross(t.ab, t.ac);
        const V4 height = dot(normal, t.a), rate = dot(normal, direction_);
        const V4 error = hn::MulAdd(hn::Mul(hn::Set(k4, kPlaneError), reach),
                                    hn::Mul(t.size, t.size), hn::Set(k4, 0x1p-100f));
        const V4 size = length(normal);
        V4 thick = hn::Mul(radius_, size);
        if (is_capsule_) thick = hn::Add(thick, hn::Abs(dot(normal, axis_)));
        apart = hn::Or(apart,
                       is_beyond(height, hn::NegMulAdd(rate, end, height), hn::Add(thick, error)));
        if (bits_of(k4, apart) == 15) return;

        const V4 edge_error =
            hn::MulAdd(hn::Mul(side_error_, reach), t.size, hn::Set(k4, 0x1p-100f));
        apart = hn::Or(apart, is_beside(t.ab, t.a, rate, edge_error));
        apart = hn::Or(apart, is_beside(t.bc, t.b, rate, edge_error));
        const Vec4 ca = {hn::Neg(t.ac.x), hn::Neg(t.ac.y), hn::Neg(t.ac.z)};
        apart = hn::Or(apart, is_beside(ca, t.c, rate, edge_error));
        found.open = ~bits_of(k4, apart) & 15;
        if (found.open == 0) return;

        const V4 speed = hn::Abs(rate);
        const V4 gap = hn::Sub(hn::Abs(height), thick);
        const V4 less = hn::Set(k4, 1 - 0x1p-20f), more = hn::Set(k4, 1 + 0x1p-20f);
        const V4 plane = hn::Mul(hn::Div(hn::Sub(gap, error), speed), less);
        const V4 path = hn::Mul(hn::Sub(first, along), inverse_square_);
        hn::Store(hn::Max(hn::Max(plane, path), enter), k4, found.earliest);

        // By this time the end of the core that is nearest is within the radius of the plane; if
        // its foot is on the triangle then, and was before, it has touched.
        const V4 latest = hn::Mul(hn::Div(hn::Add(gap, error), speed), more);
        const V4 side = hn::And(height, hn::Set(k4, -0.0f)); // its sign
        Vec4 foot = {hn::Mul(latest, direction_.x), hn::Mul(latest, direction_.y),
                     hn::Mul(latest, direction_.z)};
        if (is_capsule_) {
            const V4 turn = hn::Xor(side, hn::And(dot(normal, axis_), hn::Set(k4, -0.0f)));
            foot = {hn::Add(foot.x, hn::Xor(axis_.x, turn)),
                    hn::Add(foot.y, hn::Xor(axis_.y, turn)),
                    hn::Add(foot.z, hn::Xor(axis_.z, turn))};
        }
        const Vec4 fa = t.a - foot, fb = t.b - foot, fc = t.c - foot;
        const V4 inside =
            hn::Min(dot(cross(fa, t.ab), normal),
                    hn::Min(dot(cross(fb, t.bc), normal), dot(cross(t.ac, fc), normal)));
        // The time is off by 3 error / speed or less, for which the foot moves by |d| times that,
        // and an edge function changes by the movement * 3.5 S |normal|. Its own error, of a foot
        // below 2 R, is 600 e S S S R.
        const V4 moves = hn::Div(hn::Mul(length12_, error), speed);
        const V4 doubt = hn::MulAdd(hn::Mul(moves, t.size), size, hn::Mul(error, t.size));
        const auto sure = hn::And(hn::And(hn::Gt(inside, doubt), hn::Gt(gap, error)),
                                  hn::Gt(size, hn::Set(k4, 0x1p-45f))); // else `size` is off
        found.certain = bits_of(k4, sure) & found.open;
        hn::Store(latest, k4, found.latest);
    }

private:
    static HWY_INLINE HWY_ATTR M4 is_beyond(V4 p, V4 q, V4 reach) {
        return hn::Or(hn::Gt(hn::Min(p, q), reach), hn::Lt(hn::Max(p, q), hn::Neg(reach)));
    }

    // The box of a triangle, wider by `extent`, along one axis.
    static HWY_INLINE HWY_ATTR void meet_slab(V4 a, V4 b, V4 c, V4 extent, V4 inverse, V4& enter,
                                              V4& leave) {
        const V4 lower = hn::Mul(hn::Sub(hn::Min(a, hn::Min(b, c)), extent), inverse);
        const V4 upper = hn::Mul(hn::Add(hn::Max(a, hn::Max(b, c)), extent), inverse);
        enter = hn::Max(enter, hn::Min(lower, upper));
        leave = hn::Min(leave, hn::Max(lower, upper));
    }

    // Seen along the path: the edge is at `at`, the third vertex as far from it as the plane's rate
    // says.
    HWY_INLINE HWY_ATTR M4 is_beside(const Vec4& edge, const Vec4& start, V4 rate, V4 error) const {
        const Vec4 across = cross(direction_, edge);
        const V4 at = dot(across, start);
        V4 reach = hn::MulAdd(radius_, length(across), error);
        if (is_capsule_) reach = hn::Add(reach, hn::Abs(dot(across, axis_)));
        return is_beyond(at, hn::Add(at, rate), reach);
    }

    Vec4 origin_, direction_, axis_, extents_, inverse_;
    V4 longest_, length12_, radius_, extent_, side_error_, along_, along_error_, square_,
        inverse_square_;
    bool is_capsule_;
};

// The distance of a point from four triangles, in float: squares of what it is at least and at
// most, but for an error of 2^-19 R in the distance.
//
// The point of an edge that is looked at is one of it, 6 e R or less from the nearest, and off by
// 3 e R. The height of the plane is off by 60 e S S R. The edge functions of the foot, b x bc and
// so on times the normal, are off by 192 e S S S R: within 2^-15 S S S R both are thought of, that
// the foot is on the triangle and that it is not.
struct FourDistances {
    V4 low, high;

    HWY_INLINE HWY_ATTR FourDistances(const FourTriangles& t, V4 reach) {
        const V4 edges =
            hn::Min(to_edge(t.a, t.ab), hn::Min(to_edge(t.b, t.bc), to_edge(t.a, t.ac)));
        const Vec4 normal = cross(t.ab, t.ac);
        const V4 square = dot(normal, normal);
        const V4 height = hn::Abs(dot(normal, t.a));
        const V4 more = hn::MulAdd(hn::Set(k4, 0x1p-16f), hn::Mul(hn::Mul(t.size, t.size), reach),
                                   hn::Set(k4, 0x1p-100f));
        const V4 doubt = hn::MulAdd(hn::Add(more, more), t.size, hn::Set(k4, 0x1p-100f));
        const V4 inside =
            hn::Min(dot(cross(t.a, t.ab), normal),
                    hn::Min(dot(cross(t.b, t.bc), normal), dot(cross(t.ac, t.c), normal)));
        // Divided before they are squared, so that nothing vanishes in the denormal range; of a
        // normal that does, nothing is sure.
        const V4 near = hn::Div(hn::Max(hn::Sub(height, more), hn::Zero(k4)), length(normal));
        const V4 plane = hn::Min(edges, hn::Mul(near, near));
        low = hn::IfThenElse(hn::Lt(inside, hn::Neg(doubt)), edges, plane);
        const V4 far = hn::Div(hn::Add(height, more), hn::Sqrt(square));
        const auto sure = hn::And(hn::Gt(inside, doubt), hn::Gt(square, hn::Set(k4, 0x1p-90f)));
        high = hn::IfThenElse(sure, hn::Min(hn::Mul(far, far), edges), edges);
    }

private:
    static HWY_INLINE HWY_ATTR V4 to_edge(const Vec4& start, const Vec4& edge) {
        const V4 part = hn::Div(hn::Neg(dot(start, edge)), dot(edge, edge));
        const V4 s = hn::Min(hn::Max(part, hn::Zero(k4)), hn::Set(k4, 1.0f));
        const Vec4 p = {hn::MulAdd(s, edge.x, start.x), hn::MulAdd(s, edge.y, start.y),
                        hn::MulAdd(s, edge.z, start.z)};
        return dot(p, p);
    }
};

// Triangles whose boxes meet that of a volume at rest, and whose planes the ball around its core
// reaches.
class RestFilter {
public:
    HWY_INLINE HWY_ATTR RestFilter(const Volume& volume, double reach) {
        origin_ = splat(volume.origin);
        axis_ = splat(volume.axis);
        const double error = 0x1p-17 * reach;
        extent_ = splat(volume.extent + math::Vec3d(error));
        radius_ = hn::Set(k4, float(volume.radius) * (1 + 0x1p-20f));
        plane_error_ = hn::Set(k4, float(0x1p-14 * reach));
    }

    HWY_INLINE HWY_ATTR uint32_t maybe(const Block& block) const {
        const FourTriangles t(block, origin_);
        const auto apart = hn::Or(is_beyond(t.a.x, t.b.x, t.c.x, extent_.x),
                                  hn::Or(is_beyond(t.a.y, t.b.y, t.c.y, extent_.y),
                                         is_beyond(t.a.z, t.b.z, t.c.z, extent_.z)));
        if (bits_of(k4, apart) == 15) return 0;
        const Vec4 normal = cross(t.ab, t.ac);
        const V4 error = hn::MulAdd(plane_error_, hn::Mul(t.size, t.size), hn::Set(k4, 0x1p-100f));
        const V4 reach =
            hn::Add(hn::MulAdd(radius_, length(normal), error), hn::Abs(dot(normal, axis_)));
        const auto beside = hn::Gt(hn::Abs(dot(normal, t.a)), reach);
        return ~bits_of(k4, hn::Or(apart, beside)) & 15;
    }

private:
    static HWY_INLINE HWY_ATTR M4 is_beyond(V4 a, V4 b, V4 c, V4 extent) {
        return hn::Or(hn::Gt(hn::Min(a, hn::Min(b, c)), extent),
                      hn::Lt(hn::Max(a, hn::Max(b, c)), hn::Neg(extent)));
    }

    Vec4 origin_, axis_, extent_;
    V4 radius_, plane_error_;
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
