// Which part of a line is within a lamp's light. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_CLIP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_CLIP_INL_H
#undef PEREGRINE_SHADE_CLIP_INL_H
#else
#define PEREGRINE_SHADE_CLIP_INL_H
#endif

#include "scene/lights/prepared_light.h"
#include "simd/wide-inl.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;
using scene::PreparedLight;

// Places on a line; empty if the first is not before the last.
struct Span {
    Vf first, last;

    HWY_INLINE void cut(const Span& other) {
        first = hn::Max(first, other.first);
        last = hn::Min(last, other.last);
    }
};

HWY_INLINE Vf infinity() {
    return splat(std::numeric_limits<float>::infinity());
}

// `square`: of the line's distance from the middle, at place 0.
HWY_INLINE Span within_sphere(Vf radius_square, Vf square) {
    const Vf half = hn::Sqrt(hn::Max(hn::Sub(radius_square, square), hn::Zero(kF)));
    return {hn::Neg(half), half};
}

// Below a plane that is `gap` above place 0, for a line that rises so much by a metre.
HWY_INLINE Span below(Vf gap, Vf rise) {
    const Vf zero = hn::Zero(kF), most = infinity();
    const Mf is_level = hn::Eq(rise, zero);
    const Vf crossing = hn::Div(gap, hn::IfThenElse(is_level, splat(1.0f), rise));
    const Vf level_end = hn::IfThenElse(hn::Gt(gap, zero), most, hn::Neg(most));
    return {
        hn::IfThenElse(hn::Lt(rise, zero), crossing, hn::Neg(most)),
        hn::IfThenElse(is_level, level_end, hn::IfThenElse(hn::Gt(rise, zero), crossing, most))};
}

// Within the cone around an axis, at its tip, whose half angle has this cosine, 0 to 1. Along the
// axis the line is at a + b s, and s^2 + square is the square of its distance from the tip:
//     (b^2 - c^2) s^2 + 2 a b s + a^2 - c^2 square > 0
// is within this cone or its mirror image. Of the roots one is had as a quotient by their product,
// which holds for a line along the cone's side, too, where the other is infinite.
HWY_INLINE Span within_cone(Vf a, Vf b, Vf square, float cosine) {
    const Vf zero = hn::Zero(kF), most = infinity(), c = splat(cosine);
    const Vf bend = hn::Add(hn::Mul(hn::Sub(b, c), hn::Add(b, c)), zero); // no negative zero
    const Vf middle = hn::Mul(a, b);
    const Vf ac = hn::Mul(a, a);
    const Vf end = hn::Sub(ac, hn::Mul(hn::Mul(c, c), square));
    const Vf rest = hn::Add(ac, hn::Mul(square, bend)); // of the root, over c^2
    const Vf root = hn::Mul(c, hn::Sqrt(hn::Max(rest, zero)));
    const Vf sum = hn::Neg(hn::Add(middle, hn::CopySign(root, middle)));
    const Mf is_straight = hn::Eq(bend, zero), has_no_sum = hn::Eq(sum, zero);
    const Vf far = hn::Div(sum, bend);
    const Vf near =
        hn::IfThenElse(has_no_sum, far, hn::Div(end, hn::IfThenElse(has_no_sum, splat(1.0f), sum)));
    const Vf low = hn::Min(far, near), high = hn::Max(far, near);

    const Mf ahead = hn::Gt(a, zero), onward = hn::Gt(b, zero);
    // Steeper than the side it leaves neither cone; else it is in one of them between the roots.
    const Mf is_steep = hn::Ge(bend, zero);
    Vf first = hn::IfThenElse(is_steep, hn::IfThenElse(onward, high, hn::Neg(most)),
                              hn::IfThenElse(ahead, low, most));
    Vf last = hn::IfThenElse(is_steep, hn::IfThenElse(onward, most, low), high);
    const Mf is_beside = hn::Lt(rest, zero);
    first = hn::IfThenElse(is_beside, most, first);
    // Neither root: all of it or nothing.
    const Mf is_constant = hn::And(is_straight, has_no_sum);
    const Mf is_within = hn::And(ahead, hn::Gt(end, zero));
    first = hn::IfThenElse(is_constant, hn::IfThenElse(is_within, hn::Neg(most), most), first);
    return {first, hn::IfThenElse(hn::Or(is_constant, is_beside), most, last)};
}

// Of a spot that shines to more than a hemisphere the dark is a cone, and what is lit is before
// (part 0) and behind it (part 1).
HWY_INLINE void cut_to_cone(const PreparedLight& light, const V3& foot, const V3& along, Vf square,
                            uint32_t part, Span& way) {
    const bool is_wide = light.cone_outer_cos < 0;
    const V3 axis = splat(is_wide ? -light.direction : light.direction);
    const Span cone = within_cone(dot(axis, foot), dot(axis, along), square,
                                  is_wide ? -light.cone_outer_cos : light.cone_outer_cos);
    if (!is_wide)
        way.cut(cone);
    else if (part == 0)
        way.last = hn::Min(way.last, cone.first);
    else
        way.first = hn::Max(way.first, hn::Max(cone.first, cone.last));
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
