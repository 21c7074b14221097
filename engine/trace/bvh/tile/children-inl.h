// Which children of a node the rays of a tile enter. Included once for each instruction set, where
// a vector has eight floats.
#if defined(PEREGRINE_TRACE_BVH_TILE_CHILDREN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_TILE_CHILDREN_INL_H
#undef PEREGRINE_TRACE_BVH_TILE_CHILDREN_INL_H
#else
#define PEREGRINE_TRACE_BVH_TILE_CHILDREN_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "simd/lanes-inl.h"
#include "trace/bvh/tile/tile-inl.h"

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

using accel::bvh::Node;

// A box in the tile's frame, a child a lane, and the columns and rows of groups that may meet it.
//
// A ray of slope p that is in the box at Z = t between `begin` and `end` has p t between the least
// and the largest X of the box. Of a column, which is the slopes from `low` to `high`, the least
// product is at one end of the range, and so is the largest. The other axis likewise.
struct TileChildren {
    uint32_t entered;       // bits
    uint32_t column[4];     // bits of children
    uint32_t line[4];       // rows of groups: bits of children
    alignas(32) float z[8]; // where they begin, not behind the origin

    HWY_INLINE HWY_ATTR TileChildren(const Tile& tile, const Node& node, float limit) {
        const Range along = range(tile, node, 2);
        const V8 begin = hn::Max(along.low, hn::Zero(k8));
        const V8 end = hn::Min(along.high, hn::Set(k8, limit));
        const M8 ahead = hn::Le(begin, end);
        hn::Store(begin, k8, z);
        entered = find(range(tile, node, 0), begin, end, ahead, column)
                  & find(range(tile, node, 1), begin, end, ahead, line);
    }

    HWY_INLINE HWY_ATTR uint32_t groups(uint32_t child) const {
        const auto set = [child](const uint32_t(&bits)[4]) HWY_ATTR {
            return (bits[0] >> child & 1) | (bits[1] >> child & 1) << 1
                   | (bits[2] >> child & 1) << 2 | (bits[3] >> child & 1) << 3;
        };
        return kGroupBits.of_columns[set(column)] & kGroupBits.of_rows[set(line)];
    }

private:
    struct Range {
        V8 low, high;
    };

    static HWY_INLINE HWY_ATTR Range range(const Tile& tile, const Node& node, int i) {
        const float* const planes = &node.lower[0][0];
        V8 low = hn::Set(k8, tile.start[i] - tile.box_margin[i]);
        V8 high = hn::Set(k8, tile.start[i] + tile.box_margin[i]);
        for (size_t k = 0; k < 3; ++k) {
            const size_t first = tile.first[i][k];
            const size_t last = (2 * k + 3) * accel::bvh::kWidth - first;
            const V8 factor = hn::Set(k8, tile.row[i][k]);
            low = hn::MulAdd(hn::Load(k8, planes + first), factor, low);
            high = hn::MulAdd(hn::Load(k8, planes + last), factor, high);
        }
        return {low, high};
    }

    static HWY_INLINE HWY_ATTR uint32_t find(const Range& range, V8 begin, V8 end, M8 ahead,
                                             uint32_t (&bits)[4]) {
        for (uint32_t c = 0; c < 4; ++c) {
            const float low = slope_of_pixel(8.0f * float(c));
            const float high = slope_of_pixel(8.0f * float(c) + 7);
            const V8 least = hn::Mul(hn::Set(k8, low), low < 0 ? end : begin);
            const V8 most = hn::Mul(hn::Set(k8, high), high < 0 ? begin : end);
            bits[c] = bits_of(
                k8, hn::And(ahead, hn::And(hn::Ge(range.high, least), hn::Le(range.low, most))));
        }
        return bits[0] | bits[1] | bits[2] | bits[3];
    }
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
