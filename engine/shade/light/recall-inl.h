// What is remembered of a light's way to the points of a batch. Included once for each instruction
// set.
#if defined(PEREGRINE_SHADE_RECALL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_RECALL_INL_H
#undef PEREGRINE_SHADE_RECALL_INL_H
#else
#define PEREGRINE_SHADE_RECALL_INL_H
#endif

#include "shade/surface/ray_hits.h"
#include "shade/surface/surface.h"
#include "simd/wide-inl.h"
#include "trace/visibility/point_visibility.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// The operations of PointVisibility::at, for a run of rays that hit one triangle.
HWY_INLINE uint32_t recall_points(const trace::visibility::PointVisibility& visibility,
                                  const trace::visibility::TriangleView& view, const RayHits& hits,
                                  const TriangleRun& run, uint32_t* states) {
    using trace::visibility::Grid;
    using trace::visibility::State;
    const hn::Rebind<int32_t, Df> kS;
    const float border = Grid::kBorder[view.border()];
    const auto scale = splat(1.0f / (1.0f - 3.0f * border));
    const auto zero = hn::Zero(kF), one = splat(1.0f);
    const auto mixed = hn::Set(kU, uint32_t(State::mixed));
    const auto side = int32_t(1u << view.level());
    const auto wide = splat(float(side));
    auto all = hn::Zero(kU);
    for (uint32_t i = run.begin; i < run.end; i += kLanes) {
        const Vf x = hn::Mul(hn::Sub(hn::LoadU(kF, hits.u + i), splat(border)), scale);
        const Vf y = hn::Mul(hn::Sub(hn::LoadU(kF, hits.v + i), splat(border)), scale);
        const Mf inside =
            hn::And(hn::And(hn::Ge(x, zero), hn::Ge(y, zero)), hn::Lt(hn::Add(x, y), one));
        auto state = hn::Set(kU, uint32_t(view.state()));
        if (view.state() == State::patches) {
            const Vf xs = hn::IfThenElseZero(inside, hn::Mul(x, wide));
            const Vf ys = hn::IfThenElseZero(inside, hn::Mul(y, wide));
            const auto iu = hn::ConvertTo(kS, xs), iv = hn::ConvertTo(kS, ys);
            const Vf rest =
                hn::Add(hn::Sub(xs, hn::ConvertTo(kF, iu)), hn::Sub(ys, hn::ConvertTo(kF, iv)));
            const auto is_last =
                hn::Gt(hn::Add(iu, iv), hn::Set(kS, side - 2)); // of its row: no mirror image
            const auto upper = hn::AndNot(hn::VecFromMask(kS, is_last),
                                          hn::BitCast(kS, hn::VecFromMask(kF, hn::Ge(rest, one))));
            const auto row = hn::Mul(iv, hn::Sub(hn::Set(kS, 2 * side), iv));
            const auto index = hn::Sub(hn::Add(row, hn::Add(iu, iu)), upper); // a mask is -1
            const uint32_t* const codes = visibility.codes() + view.first_word();
            // Up to 16 patches are one word, and few triangles have more.
            const auto bits = view.level() <= 2
                                  ? hn::Set(kU, *codes)
                                  : hn::GatherIndex(kU, codes, hn::ShiftRight<4>(index));
            const auto shift = hn::BitCast(kU, hn::ShiftLeft<1>(hn::And(index, hn::Set(kS, 15))));
            state = hn::And(hn::Shr(bits, shift), hn::Set(kU, 3));
        }
        state = hn::IfThenElse(hn::RebindMask(kU, inside), state, mixed);
        hn::StoreU(state, kU, states + i);
        all = hn::Or(all, hn::Shl(hn::Set(kU, 1), state));
    }
    HWY_ALIGN uint32_t lanes[HWY_LANES(uint32_t)];
    hn::Store(all, kU, lanes);
    uint32_t occurs = 0;
    for (const uint32_t lane : lanes) occurs |= lane;
    return occurs;
}

HWY_ATTR uint32_t recall(const trace::visibility::PointVisibility& visibility,
                         const Surface& surface, uint32_t first_moving, const RayHits& hits,
                         uint32_t* states) {
    using trace::visibility::State;
    uint32_t occurs = 0;
    for (uint32_t r = 0; r < surface.run_count; ++r) {
        const TriangleRun& run = surface.runs[r];
        const uint32_t triangle = hits.triangle[run.begin];
        State state = State::hidden; // nothing was hit: nothing is lit
        if (triangle < first_moving) {
            const trace::visibility::TriangleView view = visibility.of(triangle);
            state = view.state();
            if (state == State::patches || view.border() != 0) {
                occurs |= recall_points(visibility, view, hits, run, states);
                continue;
            }
        } else if (triangle != geometry::kNoTriangle) {
            state = State::mixed;
        }
        occurs |= 1u << uint32_t(state);
        const auto fill = hn::Set(kU, uint32_t(state));
        for (uint32_t i = run.begin; i < run.end; i += kLanes) hn::StoreU(fill, kU, states + i);
    }
    return occurs;
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
