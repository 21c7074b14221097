// How much of an edge pixels are. Included once for each instruction set.
#if defined(PEREGRINE_RENDER_POST_EDGES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_RENDER_POST_EDGES_INL_H
#undef PEREGRINE_RENDER_POST_EDGES_INL_H
#else
#define PEREGRINE_RENDER_POST_EDGES_INL_H
#endif

#include "render/post/kernels.h"
#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::render::post::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

constexpr float kLightStep = 0.25f; // between neighbours, in parts of the brighter: a shadow's edge

// A vector of pixels of a row, and one of their neighbours.
struct EdgePixels {
    const EdgeRow& row;
    uint32_t x;
    Vf shown[3];
    Vf nearness;
    Vf light;
    hn::Vec<Du> look;

    HWY_INLINE EdgePixels(const EdgeRow& row_, uint32_t x_) : row(row_), x(x_) {
        for (int k = 0; k < 3; ++k) shown[k] = hn::LoadU(kF, row.shown[k] + x);
        nearness = hn::LoadU(kF, row.nearness + x);
        light = hn::Add(hn::LoadU(kF, row.light + x), splat(row.more_light));
        look = hn::LoadU(kU, row.look + x);
    }

    HWY_INLINE Vf nearness_at(ptrdiff_t offset) const {
        return hn::LoadU(kF, row.nearness + x + offset);
    }

    // Whether the three are not on one plane: there nearness changes at a constant rate.
    HWY_INLINE Mf is_bent(ptrdiff_t before, ptrdiff_t after) const {
        const Vf a = nearness_at(before), b = nearness_at(after);
        const Vf bend = hn::Abs(hn::Sub(hn::Add(a, b), hn::Add(nearness, nearness)));
        const Vf largest = hn::Max(hn::Max(a, b), nearness);
        return hn::Gt(bend, hn::Mul(largest, splat(row.most_bend)));
    }

    // The step to a neighbour if it is one of surfaces, or half of it if it is one of light: normal
    // maps have many of these.
    HWY_INLINE Vf step_to(ptrdiff_t offset, Mf is_other_plane) const {
        const Mf other_look =
            hn::RebindMask(kF, hn::Ne(hn::LoadU(kU, row.look + x + offset), look));
        const Vf there = hn::Add(hn::LoadU(kF, row.light + x + offset), splat(row.more_light));
        const Mf other_light = hn::Gt(hn::Abs(hn::Sub(there, light)),
                                      hn::Mul(hn::Max(there, light), splat(kLightStep)));
        Vf step = hn::Zero(kF);
        for (int k = 0; k < 3; ++k) {
            const Vf shown_there = hn::LoadU(kF, row.shown[k] + x + offset);
            step = hn::Max(step, hn::Abs(hn::Sub(shown_there, shown[k])));
        }
        const Vf of_light = hn::IfThenElseZero(other_light, hn::Mul(step, splat(0.5f)));
        return hn::IfThenElse(hn::Or(is_other_plane, other_look), step, of_light);
    }
};

HWY_ATTR void find_edges(const EdgeRow& row, uint32_t begin, uint32_t count, float* strengths) {
    const Mf nowhere = hn::Lt(splat(1.0f), splat(0.0f));
    for (uint32_t i = 0; i < count; i += kLanes) {
        const uint32_t x = begin + i;
        const EdgePixels pixels(row, x);
        const Vf column = hn::Iota(kF, float(int32_t(x)));
        const Mf has_left = hn::Gt(column, splat(0.0f));
        const Mf has_right = hn::Lt(column, splat(float(int32_t(row.width - 1))));
        const Mf bent = hn::And(hn::And(has_left, has_right), pixels.is_bent(-1, 1));
        Vf strength = hn::Max(hn::IfThenElseZero(has_left, pixels.step_to(-1, bent)),
                              hn::IfThenElseZero(has_right, pixels.step_to(1, bent)));
        const Mf bent_down =
            row.above && row.below ? pixels.is_bent(row.above, row.below) : nowhere;
        if (row.above) strength = hn::Max(strength, pixels.step_to(row.above, bent_down));
        if (row.below) strength = hn::Max(strength, pixels.step_to(row.below, bent_down));
        hn::StoreU(hn::Mul(strength, splat(255.0f)), kF, strengths + i);
    }
}

} // namespace peregrine::render::post::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
