// Soft discs of light. Included once for each instruction set.
#if defined(PEREGRINE_RENDER_POST_SPRITES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_RENDER_POST_SPRITES_INL_H
#undef PEREGRINE_RENDER_POST_SPRITES_INL_H
#else
#define PEREGRINE_RENDER_POST_SPRITES_INL_H
#endif

#include "render/post/kernels.h"
#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::render::post::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// (1 - r^2)^2 of the distance r from the middle, in radii. What is nearer than the middle fades out
// within a radius of it.
HWY_ATTR void add_sprite(const Sprite& sprite, const SpriteArea& area, const float* depth,
                         float* const light[3]) {
    const Vf zero = hn::Zero(kF), one = splat(1.0f);
    const uint32_t begin = area.begin_x / kLanes * kLanes;
    for (uint32_t y = area.begin_y; y < area.end_y; ++y) {
        const float down = (float(int32_t(area.top + y)) + 0.5f - sprite.y) * sprite.by_height;
        const Vf rest = splat(1.0f - down * down);
        for (uint32_t x = begin; x < area.end_x; x += kLanes) {
            const uint32_t i = y * SpriteArea::kStride + x;
            const Vf column = hn::Iota(kF, float(int32_t(area.left + x)) + 0.5f);
            const Vf across = hn::Mul(hn::Sub(column, splat(sprite.x)), splat(sprite.by_width));
            const Vf disc = hn::Max(hn::Sub(rest, hn::Mul(across, across)), zero);
            const Vf behind = hn::Sub(hn::LoadU(kF, depth + i), splat(sprite.depth));
            const Vf shows = hn::Add(hn::Mul(behind, splat(sprite.by_depth)), one);
            const Vf part = hn::Mul(hn::Mul(disc, disc), hn::Min(hn::Max(shows, zero), one));
            for (int k = 0; k < 3; ++k)
                hn::StoreU(
                    hn::Add(hn::LoadU(kF, light[k] + i), hn::Mul(splat(sprite.color[k]), part)), kF,
                    light[k] + i);
        }
    }
}

} // namespace peregrine::render::post::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
