// Blocks of rays along Morton's curve. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_BLOCKS_INL_H
#undef PEREGRINE_SHADE_BLOCKS_INL_H
#else
#define PEREGRINE_SHADE_BLOCKS_INL_H
#endif

#include "shade/blocks/block.h"
#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Where the rays of a block are, in pixels from its first.
struct BlockPlaces {
    alignas(64) float x[Block::kMost * Block::kMost];
    alignas(64) float y[Block::kMost * Block::kMost];
};

constexpr BlockPlaces make_block_places() {
    BlockPlaces places{};
    for (uint32_t i = 0; i < Block::kMost * Block::kMost; ++i) {
        uint32_t x = 0, y = 0;
        for (uint32_t bit = 0; bit < 4; ++bit) {
            x |= (i >> 2 * bit & 1) << bit;
            y |= (i >> (2 * bit + 1) & 1) << bit;
        }
        places.x[i] = float(x);
        places.y[i] = float(y);
    }
    return places;
}

inline constexpr BlockPlaces kBlockPlaces = make_block_places();

// Whether what is seen in a block lies within a part of its side of a plane. On a plane 1 / t
// changes at a constant rate from pixel to pixel, t being measured along the camera's forward.
HWY_ATTR bool block_is_smooth(const float* t, uint32_t side, float pixel, float part) {
    const uint32_t size = side * side, across = size / 3;
    const float origin = 1.0f / t[0], step = 1.0f / float(side - 1);
    const Vf by_x = splat((1.0f / t[across] - origin) * step);
    const Vf by_y = splat((1.0f / t[2 * across] - origin) * step);
    const Vf allowed = splat(float(side) * pixel * part * origin);
    for (uint32_t i = 0; i < size; i += kLanes) {
        const Vf x = hn::LoadU(kF, kBlockPlaces.x + i), y = hn::LoadU(kF, kBlockPlaces.y + i);
        const Vf plane = hn::Add(splat(origin), hn::Add(hn::Mul(by_x, x), hn::Mul(by_y, y)));
        const Vf seen = hn::Div(splat(1.0f), hn::LoadU(kF, t + i));
        if (!hn::AllTrue(kF, hn::Le(hn::Abs(hn::Sub(seen, plane)), allowed))) return false;
    }
    return true;
}

// Fills a block with what lies between its corners' values.
HWY_ATTR void interpolate_block(float* values, uint32_t side) {
    const uint32_t size = side * side, across = size / 3;
    const float a = values[0], b = values[across], c = values[2 * across], d = values[size - 1];
    const Vf step = splat(1.0f / float(side - 1));
    for (uint32_t i = 0; i < size; i += kLanes) {
        const Vf x = hn::Mul(hn::LoadU(kF, kBlockPlaces.x + i), step);
        const Vf y = hn::Mul(hn::LoadU(kF, kBlockPlaces.y + i), step);
        const Vf upper = hn::Add(splat(a), hn::Mul(splat(b - a), x));
        const Vf lower = hn::Add(splat(c), hn::Mul(splat(d - c), x));
        hn::StoreU(hn::Add(upper, hn::Mul(hn::Sub(lower, upper), y)), kF, values + i);
    }
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
