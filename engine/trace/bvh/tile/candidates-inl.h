// Which rays of a tile may hit a facet, as far as linear functions tell. Included once for each
// instruction set, where a vector has eight floats.
#if defined(PEREGRINE_TRACE_BVH_TILE_CANDIDATES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_TILE_CANDIDATES_INL_H
#undef PEREGRINE_TRACE_BVH_TILE_CANDIDATES_INL_H
#else
#define PEREGRINE_TRACE_BVH_TILE_CANDIDATES_INL_H
#endif

#include <hwy/highway.h>

#include "simd/lanes-inl.h"
#include "trace/bvh/tile/facet-inl.h"
#include "trace/bvh/tile/tile-inl.h"

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Slopes at the middle of each group, at the first pixel of each eight of a group less those of the
// group's first, and of the pixels of an eight likewise.
struct TilePlaces {
    alignas(64) float group_p[kTileGroups], group_q[kTileGroups];
    alignas(32) float eight_p[8], eight_q[8];
    alignas(32) float pixel_p[8], pixel_q[8];
    // Which eights of a group are in a set of its columns of eights (2 bits) and rows (4 bits).
    uint8_t eights[4][16];

    constexpr TilePlaces()
        : group_p(), group_q(), eight_p(), eight_q(), pixel_p(), pixel_q(), eights() {
        for (uint32_t g = 0; g < kTileGroups; ++g) {
            group_p[g] = slope_of_pixel(8.0f * float(GroupBits::column(g)) + 3.5f);
            group_q[g] = slope_of_pixel(8.0f * float(GroupBits::row(g)) + 3.5f);
        }
        for (uint32_t i = 0; i < 8; ++i) {
            const uint32_t column = i >> 1 & 1, row = (i & 1) | (i >> 1 & 2);
            eight_p[i] = kPixelSlope * 4 * float(column);
            eight_q[i] = kPixelSlope * 2 * float(row);
            pixel_p[i] = kPixelSlope * float((i & 1) | (i >> 1 & 2));
            pixel_q[i] = kPixelSlope * float(i >> 1 & 1);
            for (uint32_t columns = 0; columns < 4; ++columns)
                for (uint32_t rows = 0; rows < 16; ++rows)
                    if ((columns >> column & 1) && (rows >> row & 1))
                        eights[columns][rows] |= uint8_t(1u << i);
        }
    }
};
inline constexpr TilePlaces kTilePlaces;

// From bit `first` to bit `last`.
inline uint32_t bits_between(int32_t first, int32_t last) {
    return (2u << last) - (1u << first);
}

// The groups whose pixels meet a facet's window.
HWY_INLINE HWY_ATTR uint32_t groups_in_window(const TileFacets& facets, uint32_t lane) {
    return kGroupBits.of_columns[bits_between(facets.x0[lane] >> 3, facets.x1[lane] >> 3)]
           & kGroupBits.of_rows[bits_between(facets.y0[lane] >> 3, facets.y1[lane] >> 3)];
}

// ... and the eights of one of these.
HWY_INLINE HWY_ATTR uint32_t eights_in_window(const TileFacets& facets, uint32_t lane,
                                              uint32_t group) {
    const uint32_t columns = bits_between(facets.x0[lane] >> 2, facets.x1[lane] >> 2);
    const uint32_t rows = bits_between(facets.y0[lane] >> 1, facets.y1[lane] >> 1);
    return kTilePlaces.eights[columns >> 2 * GroupBits::column(group) & 3]
                             [rows >> 4 * GroupBits::row(group) & 15];
}

// A facet of which edges and plane are known, in all lanes.
struct TileEdges {
    V8 a[3], b[3], c[3]; // as TileFacets has them
    V8 na, nb, nc;
    V8 height;
    V8 sure;

    HWY_INLINE HWY_ATTR TileEdges(const TileFacets& facets, uint32_t lane) {
        for (int k = 0; k < 3; ++k) {
            a[k] = hn::Set(k8, facets.a[k][lane]);
            b[k] = hn::Set(k8, facets.b[k][lane]);
            c[k] = hn::Set(k8, facets.c[k][lane]);
        }
        na = hn::Set(k8, facets.det_a[lane]);
        nb = hn::Set(k8, facets.det_b[lane]);
        nc = hn::Set(k8, facets.det_c[lane]);
        height = hn::Set(k8, facets.height[lane]);
        sure = hn::Set(k8, facets.sure[lane]);
    }

    // The groups of `mask` that may be hit; `inside` are those with all rays within all edges. A
    // group's slopes reach 3.5 pixels from its middle.
    HWY_INLINE HWY_ATTR uint32_t find_groups(const Tile& tile, uint32_t mask,
                                             uint32_t& inside) const {
        const V8 half = hn::Set(k8, 3.5f * kPixelSlope);
        uint32_t open = 0;
        inside = 0;
        for (uint32_t g = 0; g < kTileGroups; g += kLanes8) {
            const V8 p = hn::Load(k8, kTilePlaces.group_p + g);
            const V8 q = hn::Load(k8, kTilePlaces.group_q + g);
            V8 most = hn::Set(k8, std::numeric_limits<float>::infinity()), least = most;
            for (int k = 0; k < 3; ++k) {
                const V8 middle = hn::MulAdd(a[k], p, hn::MulAdd(b[k], q, c[k]));
                const V8 range = hn::Mul(hn::Add(hn::Abs(a[k]), hn::Abs(b[k])), half);
                most = hn::Min(most, hn::Add(middle, range));
                least = hn::Min(least, hn::Sub(middle, range));
            }
            const V8 n = hn::MulAdd(hn::Add(hn::Abs(na), hn::Abs(nb)), half,
                                    hn::MulAdd(na, p, hn::MulAdd(nb, q, nc)));
            const V8 limit = hn::Load(k8, tile.group_limit + g);
            const auto missed =
                hn::Or(hn::Lt(most, hn::Zero(k8)), hn::Lt(hn::Mul(n, limit), height));
            open |= (~bits_of(k8, missed) & 255u) << g;
            inside |= bits_of(k8, hn::Gt(least, sure)) << g;
        }
        return open & mask;
    }
};

// The edges over the rays of a group, eight by eight.
struct TileGroupEdges {
    alignas(32) float edge[3][8], n[8]; // at the first pixel of each eight
    uint32_t open;                      // eights with rays that may be inside

    HWY_INLINE HWY_ATTR TileGroupEdges(const TileEdges& edges, uint32_t group) {
        const float corner = 3.5f * kPixelSlope;
        const V8 p = hn::Add(hn::Load(k8, kTilePlaces.eight_p),
                             hn::Set(k8, kTilePlaces.group_p[group] - corner));
        const V8 q = hn::Add(hn::Load(k8, kTilePlaces.eight_q),
                             hn::Set(k8, kTilePlaces.group_q[group] - corner));
        V8 most = hn::Set(k8, std::numeric_limits<float>::infinity());
        for (int k = 0; k < 3; ++k) {
            const V8 first = hn::MulAdd(edges.a[k], p, hn::MulAdd(edges.b[k], q, edges.c[k]));
            hn::Store(first, k8, edge[k]);
            const V8 range =
                hn::MulAdd(hn::Max(edges.a[k], hn::Zero(k8)), hn::Set(k8, 3 * kPixelSlope),
                           hn::Mul(hn::Max(edges.b[k], hn::Zero(k8)), hn::Set(k8, kPixelSlope)));
            most = hn::Min(most, hn::Add(first, range));
        }
        hn::Store(hn::MulAdd(edges.na, p, hn::MulAdd(edges.nb, q, edges.nc)), k8, n);
        open = bits_of(k8, hn::Ge(most, hn::Zero(k8)));
    }
};

// What the functions add from the first pixel of an eight to the others.
struct TileSteps {
    V8 edge[3], n;

    HWY_INLINE HWY_ATTR explicit TileSteps(const TileEdges& edges) {
        const V8 p = hn::Load(k8, kTilePlaces.pixel_p), q = hn::Load(k8, kTilePlaces.pixel_q);
        for (int k = 0; k < 3; ++k) edge[k] = hn::MulAdd(edges.a[k], p, hn::Mul(edges.b[k], q));
        n = hn::MulAdd(edges.na, p, hn::Mul(edges.nb, q));
    }

    // Rays of an eight whose closest hits are `best` that may be hit.
    template <bool Inside>
    HWY_INLINE HWY_ATTR M8 find(const TileEdges& edges, const TileGroupEdges& group, uint32_t eight,
                                V8 best) const {
        const V8 along = hn::Add(n, hn::Set(k8, group.n[eight]));
        const M8 far = hn::Lt(hn::Mul(along, best), edges.height);
        if constexpr (Inside) return hn::Not(far);
        const V8 least = hn::Min(hn::Add(edge[0], hn::Set(k8, group.edge[0][eight])),
                                 hn::Min(hn::Add(edge[1], hn::Set(k8, group.edge[1][eight])),
                                         hn::Add(edge[2], hn::Set(k8, group.edge[2][eight]))));
        return hn::AndNot(far, hn::Ge(least, hn::Zero(k8)));
    }
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
