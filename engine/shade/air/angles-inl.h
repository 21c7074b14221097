// Angles without a library's functions: the same bits everywhere. Included once for each
// instruction set.
#if defined(PEREGRINE_SHADE_ANGLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_ANGLES_INL_H
#undef PEREGRINE_SHADE_ANGLES_INL_H
#else
#define PEREGRINE_SHADE_ANGLES_INL_H
#endif

#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

template <size_t Count>
HWY_INLINE Vf polynomial(Vf x, const float (&factors)[Count]) {
    Vf sum = splat(factors[0]);
    for (size_t i = 1; i < Count; ++i) sum = hn::Add(hn::Mul(sum, x), splat(factors[i]));
    return sum;
}

// For x from 0 to 1, within 1e-7 (Abramowitz and Stegun, 4.4.49).
HWY_INLINE Vf arc_tangent(Vf x) {
    constexpr float kFactors[] = {0.0028662257f,  -0.0161657367f, 0.0429096138f,
                                  -0.0752896400f, 0.1065626393f,  -0.1420889944f,
                                  0.1999355085f,  -0.3333314528f, 1.0f};
    return hn::Mul(x, polynomial(hn::Mul(x, x), kFactors));
}

// Of the angle from -pi / 2 to pi / 2, within 5e-7 (Taylor).
HWY_INLINE Vf sine_of(Vf angle) {
    constexpr float kFactors[] = {-1.0f / 39916800, 1.0f / 362880, -1.0f / 5040,
                                  1.0f / 120,       -1.0f / 6,     1.0f};
    return hn::Mul(angle, polynomial(hn::Mul(angle, angle), kFactors));
}
HWY_INLINE Vf cosine_of(Vf angle) {
    constexpr float kFactors[] = {1.0f / 479001600, -1.0f / 3628800, 1.0f / 40320, -1.0f / 720,
                                  1.0f / 24,        -1.0f / 2,       1.0f};
    return polynomial(hn::Mul(angle, angle), kFactors);
}

// The angles whose tangents are first / spread and last / spread: the middle one, and half of what
// is between. The middle one is that of the sum of two unit vectors.
struct AngleRange {
    Vf cosine, sine, half;

    HWY_INLINE AngleRange(Vf first, Vf last, Vf spread) {
        const Vf one = splat(1.0f);
        const auto inverse_length = [&](Vf x, Vf y) {
            return hn::Div(one, hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y))));
        };
        const Vf to_first = inverse_length(spread, first), to_last = inverse_length(spread, last);
        const Vf first_cosine = hn::Mul(spread, to_first), first_sine = hn::Mul(first, to_first);
        const Vf x = hn::Add(first_cosine, hn::Mul(spread, to_last));
        const Vf y = hn::Add(first_sine, hn::Mul(last, to_last));
        const Vf inverse = inverse_length(x, y);
        cosine = hn::Mul(x, inverse);
        sine = hn::Mul(y, inverse);
        const Vf half_sine = hn::Sub(hn::Mul(sine, first_cosine), hn::Mul(cosine, first_sine));
        const Vf half_cosine = hn::Add(hn::Mul(cosine, first_cosine), hn::Mul(sine, first_sine));
        const Vf tangent = hn::Div(half_sine, hn::Add(one, half_cosine)); // of half of the half
        const Vf quarter = arc_tangent(hn::Min(hn::Max(tangent, hn::Zero(kF)), one));
        half = hn::Add(quarter, quarter);
    }
};

// An angle so much beyond that of (cosine, sine).
struct Angle {
    Vf cosine, sine;

    HWY_INLINE Angle(Vf cosine_, Vf sine_, Vf beyond) {
        const Vf c = cosine_of(beyond), s = sine_of(beyond);
        cosine = hn::Max(hn::Sub(hn::Mul(cosine_, c), hn::Mul(sine_, s)), splat(1e-7f));
        sine = hn::Add(hn::Mul(sine_, c), hn::Mul(cosine_, s));
    }

    // Where it meets a line that is so far away.
    HWY_INLINE Vf place(Vf spread, Vf first, Vf last) const {
        return hn::Min(hn::Max(hn::Div(hn::Mul(spread, sine), cosine), first), last);
    }
};

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
