// A picture enlarged along its edges. Included once for each instruction set.
#if defined(PEREGRINE_RENDER_POST_ENLARGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_RENDER_POST_ENLARGE_INL_H
#undef PEREGRINE_RENDER_POST_ENLARGE_INL_H
#else
#define PEREGRINE_RENDER_POST_ENLARGE_INL_H
#endif

#include "render/post/kernels.h"
#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::render::post::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

constexpr float kAlongEdge = 0.6f; // by so much distances along a clear edge count less

// Sums over the four middle taps, weighted by how near they are: which way the picture changes
// (its structure tensor).
struct Change {
    Vf xx, xy, yy;

    HWY_INLINE Change() : xx(hn::Zero(kF)), xy(hn::Zero(kF)), yy(hn::Zero(kF)) {}

    HWY_INLINE void add(Vf x, Vf y, Vf weight) {
        const Vf weighted_x = hn::Mul(x, weight);
        xx = hn::Add(xx, hn::Mul(weighted_x, x));
        xy = hn::Add(xy, hn::Mul(weighted_x, y));
        yy = hn::Add(yy, hn::Mul(hn::Mul(y, weight), y));
    }
};

// The square of a distance, shorter along an edge: a x^2 + b x y + c y^2.
struct EdgeDistance {
    Vf a, b, c;

    explicit HWY_INLINE EdgeDistance(const Change& change) {
        const Vf across = hn::Sub(change.xx, change.yy), twice = hn::Add(change.xy, change.xy);
        const Vf length = hn::Sqrt(hn::Add(hn::Mul(across, across), hn::Mul(twice, twice)));
        // 1 where all changes go one way; 0 where they go all ways, or nothing changes.
        const Vf clear =
            hn::Div(splat(0.5f * kAlongEdge), hn::Add(hn::Add(change.xx, change.yy), splat(1e-4f)));
        const Vf middle = hn::Sub(splat(1.0f), hn::Mul(length, clear));
        const Vf by_direction = hn::Mul(across, clear), turned = hn::Mul(twice, clear);
        a = hn::Add(middle, by_direction);
        b = hn::Add(turned, turned);
        c = hn::Sub(middle, by_direction);
    }
};

// (1 - 0.7 q) (1 - q/4)^3 of a squared distance q: 0 from 2 pixels on. With 1 for 0.7 clean
// pictures get sharper, but those with noise in their textures worse.
HWY_INLINE Vf tap_weight(Vf squared) {
    const Vf q = hn::Min(squared, splat(4.0f));
    const Vf lobe = hn::Sub(splat(1.0f), hn::Mul(q, splat(0.7f)));
    const Vf rest = hn::Sub(splat(1.0f), hn::Mul(q, splat(0.25f)));
    return hn::Mul(hn::Mul(lobe, rest), hn::Mul(rest, rest));
}

HWY_INLINE Vf load_tap(const TapRow& row, int channel, int column, uint32_t i) {
    return hn::Load(kF, row.tap[channel][column] + i);
}

// Of the 16 taps; these four are left out.
constexpr bool is_corner(int row, int column) {
    return (row == 0 || row == 3) && (column == 0 || column == 3);
}

HWY_INLINE Change find_change(const TapRow* const rows[4], uint32_t i, Vf x, Vf y) {
    Vf bright[4][4];
    for (int r = 0; r < 4; ++r)
        for (int k = 0; k < 4; ++k) {
            if (is_corner(r, k)) continue;
            const Vf sides = hn::Add(load_tap(*rows[r], 0, k, i), load_tap(*rows[r], 2, k, i));
            bright[r][k] = hn::Add(hn::Mul(sides, splat(0.25f)),
                                   hn::Mul(load_tap(*rows[r], 1, k, i), splat(0.5f)));
        }
    const Vf one = splat(1.0f);
    const Vf by_column[2] = {hn::Sub(one, x), x}, by_row[2] = {hn::Sub(one, y), y};
    Change change;
    for (int r = 1; r < 3; ++r)
        for (int k = 1; k < 3; ++k)
            change.add(hn::Sub(bright[r][k + 1], bright[r][k - 1]),
                       hn::Sub(bright[r + 1][k], bright[r - 1][k]),
                       hn::Mul(by_row[r - 1], by_column[k - 1]));
    return change;
}

// What the 12 taps give, kept between the four in the middle: no halos.
struct TapSum {
    Vf sum, least, most;

    HWY_INLINE TapSum(const TapRow* const rows[4], int channel, uint32_t i) : sum(hn::Zero(kF)) {
        const Vf a = load_tap(*rows[1], channel, 1, i), b = load_tap(*rows[1], channel, 2, i);
        const Vf c = load_tap(*rows[2], channel, 1, i), d = load_tap(*rows[2], channel, 2, i);
        least = hn::Min(hn::Min(a, b), hn::Min(c, d));
        most = hn::Max(hn::Max(a, b), hn::Max(c, d));
    }
    HWY_INLINE void add(Vf weight, Vf value) { sum = hn::Add(sum, hn::Mul(weight, value)); }
    HWY_INLINE Vf mean(Vf weights) const {
        return hn::Min(hn::Max(hn::Div(sum, weights), least), most);
    }
};

HWY_ATTR void enlarge_row(const TapRow* const rows[4], const float* between, float down,
                          uint32_t count, float* const shown[3]) {
    const Vf y = splat(down);
    for (uint32_t i = 0; i < count; i += kLanes) {
        const Vf x = hn::LoadU(kF, between + i);
        const EdgeDistance distance(find_change(rows, i, x, y));
        TapSum sums[3] = {{rows, 0, i}, {rows, 1, i}, {rows, 2, i}};
        Vf weights = hn::Zero(kF);
        for (int r = 0; r < 4; ++r) {
            const Vf dy = hn::Sub(splat(float(r - 1)), y);
            const Vf by_row = hn::Mul(hn::Mul(distance.c, dy), dy);
            const Vf mixed = hn::Mul(distance.b, dy);
            for (int k = 0; k < 4; ++k) {
                if (is_corner(r, k)) continue;
                const Vf dx = hn::Sub(splat(float(k - 1)), x);
                const Vf by_column = hn::Mul(hn::Add(hn::Mul(distance.a, dx), mixed), dx);
                const Vf weight = tap_weight(hn::Add(by_row, by_column));
                weights = hn::Add(weights, weight);
                for (int c = 0; c < 3; ++c) sums[c].add(weight, load_tap(*rows[r], c, k, i));
            }
        }
        for (int c = 0; c < 3; ++c) hn::StoreU(sums[c].mean(weights), kF, shown[c] + i);
    }
}

} // namespace peregrine::render::post::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
