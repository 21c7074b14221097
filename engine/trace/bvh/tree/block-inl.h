// One ray and a block of four triangles. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_TREE_BLOCK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_TREE_BLOCK_INL_H
#undef PEREGRINE_TRACE_BVH_TREE_BLOCK_INL_H
#else
#define PEREGRINE_TRACE_BVH_TREE_BLOCK_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "geometry/intersect.h"
#include "simd/lanes-inl.h"
#include "trace/bvh/tree/four_triangles-inl.h"
#include "trace/bvh/tree/push-inl.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// The edge functions in float. Rounding is monotone: one that is not 0 has the sign of the exact
// one, so `outside` lanes are missed for certain, and in `inside` lanes only t can miss.
template <class V>
struct EdgeSigns {
    V u, v, w;
    hn::Mask<hn::DFromV<V>> outside, inside;

    HWY_INLINE HWY_ATTR explicit EdgeSigns(const Sheared<V>& s) : u(s.u()), v(s.v()), w(s.w()) {
        const V zero = hn::Zero(hn::DFromV<V>());
        outside = trace::HWY_NAMESPACE::outside(u, v, w);
        inside = hn::Or(hn::Gt(hn::Min(u, hn::Min(v, w)), zero),
                        hn::Lt(hn::Max(u, hn::Max(v, w)), zero));
    }

    HWY_INLINE HWY_ATTR uint32_t maybe() const {
        constexpr hn::DFromV<V> d;
        return ~bits_of(d, outside) & ((1u << hn::MaxLanes(d)) - 1);
    }
};

// By how much t lies inside its range, in float and without a division: the lesser of
// depth - t_min |dz| |det| and t_max |dz| |det| - depth, and how far off that can be.
//
// With X, Y, Z the largest |x|, |y|, |z| of a triangle, T the largest |t dz| of interest,
// Z <= D = `reach`, T <= 2 D, e = 2^-24: an edge function is at most 2 X Y and off by 4.1 e X Y; so
// det is off by 22.4 e X Y, depth by 28.4 e X Y Z. Their part in the margin is 73.2 e X Y D; the
// products with T, the differences and the rounding of the exact t to float add 48 e X Y D. The sum
// is 121.2 e X Y D; 128 are taken, and 2^-100 for what is lost in the denormal range. (Should the
// float det have the wrong sign, then it and the exact one are below 22.4 e X Y, and the margin is
// within the same bound.) All numbers on the way are below 32 X Y D: where one overflows, so does
// that, and nothing is certain.
//
// Beyond +-2 D there is nothing to hit: z_min is t_min |dz| or -2 D, z_max t_max |dz| or 2 D.
template <class V>
struct RangeMargin {
    V margin, error;

    // `scale` is 32 D with the sign of dz.
    HWY_INLINE HWY_ATTR RangeMargin(const Sheared<V>& s, const EdgeSigns<V>& e, V z_min, V z_max,
                                    V scale) {
        constexpr hn::DFromV<V> d;
        const V det = hn::Add(hn::Add(e.u, e.v), e.w);
        const V depth = hn::MulAdd(e.w, s.cz, hn::MulAdd(e.v, s.bz, hn::Mul(e.u, s.az)));
        const V sign = hn::And(hn::Xor(det, scale), hn::Set(d, -0.0f));
        const V along = hn::Xor(depth, sign);
        const V size = hn::Abs(det);
        margin = hn::Min(hn::NegMulAdd(z_min, size, along), hn::MulSub(z_max, size, along));
        const auto largest = [](V a, V b, V c) HWY_ATTR {
            return hn::Max(hn::Abs(a), hn::Max(hn::Abs(b), hn::Abs(c)));
        };
        const V xy = hn::Mul(largest(s.ax, s.bx, s.cx), largest(s.ay, s.by, s.cy));
        const V most = hn::Mul(xy, hn::Abs(scale));
        error = hn::MulAdd(most, hn::Set(d, 0x1p-21f), hn::Set(d, 0x1p-100f));
    }

    HWY_INLINE HWY_ATTR auto in_range() const { return hn::Gt(margin, error); }
    HWY_INLINE HWY_ATTR uint32_t maybe() const {
        constexpr hn::DFromV<V> d;
        return ~bits_of(d, hn::Lt(margin, hn::Neg(error))) & ((1u << hn::MaxLanes(d)) - 1);
    }
};

// What of a ray the test needs, in all lanes.
struct BlockRay {
    V4 ox, oy, oz;
    V4 sx, sy;
    Vd dz;
    float t_min, t_max;
    V4 dz_abs, z_min, limit, scale; // as RangeMargin has them; limit is 2 D
    size_t kx, ky, kz;              // offsets of the axes in a vertex of a block, in floats

    // geometry::shear, without a branch on which axis is the largest.
    HWY_INLINE HWY_ATTR BlockRay(const RayLanes& lanes, const math::Ray& ray) {
        const hn::RebindToUnsigned<D4> u4;
        alignas(16) static constexpr uint32_t kAxes[3][4] = {
            {1, 2, 0, 3}, {2, 0, 1, 3}, {0, 1, 2, 3}};
        const uint32_t* axes = kAxes[lanes.kz];
        const auto turn = hn::IndicesFromVec(k4, hn::Load(u4, axes));
        const V4 origin = hn::TableLookupLanes(lanes.origin, turn);
        const V4 direction = hn::TableLookupLanes(lanes.direction, turn);
        const V4 along = hn::Broadcast<2>(direction);
        const V4 slope = hn::Div(direction, along);
        ox = hn::Broadcast<0>(origin);
        oy = hn::Broadcast<1>(origin);
        oz = hn::Broadcast<2>(origin);
        sx = hn::Broadcast<0>(slope);
        sy = hn::Broadcast<1>(slope);
        dz = promote_part(along, 0);
        dz_abs = hn::Abs(along);
        limit = hn::Add(lanes.reach, lanes.reach);
        scale = hn::CopySign(hn::Mul(hn::Set(k4, 32.0f), lanes.reach), along);
        z_min = hn::Max(hn::Mul(hn::Set(k4, ray.t_min), dz_abs), hn::Neg(limit));
        constexpr float kLargest = std::numeric_limits<float>::max();
        t_min = ray.t_min > -kLargest ? ray.t_min : -kLargest;
        t_max = ray.t_max < kLargest ? ray.t_max : kLargest;
        kx = axes[0] * accel::bvh::kBlockWidth;
        ky = axes[1] * accel::bvh::kBlockWidth;
        kz = axes[2] * accel::bvh::kBlockWidth;
    }

    HWY_INLINE HWY_ATTR Sheared<V4> relative(const Block& block) const {
        return relative_to(block, kx, ky, kz, ox, oy, oz, sx, sy);
    }
    HWY_INLINE HWY_ATTR RangeMargin<V4> range(const Sheared<V4>& s, const EdgeSigns<V4>& e,
                                              float end) const {
        const V4 z_max = hn::Min(hn::Mul(hn::Set(k4, end), dz_abs), limit);
        return {s, e, z_min, z_max, scale};
    }
};

// The triangles of the block that the ray hits up to t_max; false if there are none.
HWY_INLINE HWY_ATTR bool intersect(const BlockRay& ray, const Block& block, float t_max,
                                   BlockHits& hits) {
    const Sheared<V4> sheared = ray.relative(block);
    const EdgeSigns<V4> edges(sheared);
    uint32_t maybe = edges.maybe();
    if (maybe == 0) return false;
    maybe &= ray.range(sheared, edges, t_max).maybe();
    return maybe != 0 && decide_block<Details::all>(sheared, ray.dz, ray.t_min, t_max, hits);
}

// Whether the ray hits a triangle of the block. Doubles decide what float is too coarse for: rays
// through edges, and ends of rays on triangles.
HWY_INLINE HWY_ATTR bool intersects(const BlockRay& ray, const Block& block) {
    const Sheared<V4> sheared = ray.relative(block);
    const EdgeSigns<V4> edges(sheared);
    uint32_t maybe = edges.maybe();
    if (maybe == 0) return false;
    const RangeMargin<V4> range = ray.range(sheared, edges, ray.t_max);
    if (bits_of(k4, hn::And(edges.inside, range.in_range()))) return true;
    maybe &= range.maybe();
    if (maybe == 0) return false;
    BlockHits hits;
    return decide_block<Details::none>(sheared, ray.dz, ray.t_min, ray.t_max, hits);
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
