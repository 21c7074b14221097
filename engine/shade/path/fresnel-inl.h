// Mirrored and bent directions, and how much light goes either way. Included once for each
// instruction set.
#if defined(PEREGRINE_SHADE_FRESNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_FRESNEL_INL_H
#undef PEREGRINE_SHADE_FRESNEL_INL_H
#else
#define PEREGRINE_SHADE_FRESNEL_INL_H
#endif

#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", Computer Graphics Forum,
// 1994: from `head_on` to 1.
HWY_INLINE V3 schlick(const V3& head_on, Vf cosine) {
    const V3 one = splat(math::Vec3(1));
    const Vf s = hn::Sub(one.x, cosine);
    const Vf ss = hn::Mul(s, s);
    return add(head_on, scale(subtract(one, head_on), hn::Mul(hn::Mul(ss, ss), s)));
}

// Fresnel's equations for unpolarised light between two indices, `eta` the one that it comes from
// over the other.
struct Refraction {
    Vf cosine_beyond; // 0 if all is reflected
    Vf reflectance;

    HWY_INLINE Refraction(Vf cosine, Vf eta) {
        const Vf one = splat(1.0f), tiny = splat(1e-20f);
        const Vf sine_square = hn::Mul(hn::Mul(eta, eta), hn::Sub(one, hn::Mul(cosine, cosine)));
        const Vf rest = hn::Sub(one, sine_square);
        const Mf is_total = hn::Le(rest, hn::Zero(kF));
        cosine_beyond = hn::Sqrt(hn::Max(rest, hn::Zero(kF)));
        const Vf near = hn::Mul(eta, cosine), far = hn::Mul(eta, cosine_beyond);
        const Vf s =
            hn::Div(hn::Sub(near, cosine_beyond), hn::Max(hn::Add(near, cosine_beyond), tiny));
        const Vf p = hn::Div(hn::Sub(cosine, far), hn::Max(hn::Add(cosine, far), tiny));
        const Vf mean = hn::Mul(splat(0.5f), hn::Add(hn::Mul(s, s), hn::Mul(p, p)));
        reflectance = hn::IfThenElse(is_total, one, mean);
    }
};

// Of a thin sheet, with all that goes to and fro in it: R + (1 - R)^2 R + (1 - R)^2 R^3 + ...
HWY_INLINE Vf of_both_sides(Vf reflectance) {
    return hn::Div(hn::Add(reflectance, reflectance), hn::Add(splat(1.0f), reflectance));
}

// How a ray meets a surface. Smooth normals and normal maps may say what the triangle can't: a
// normal that faces away, light that is mirrored into the surface.
struct View {
    V3 direction; // unit
    Vf length;    // of the ray's own
    V3 normal;
    V3 geometric;
    Vf cosine; // between the normal and the way back, 0 to 1

    HWY_INLINE View(const V3& along, const V3& shading_normal, const V3& geometric_)
        : geometric(geometric_) {
        const Vf zero = hn::Zero(kF);
        length = hn::Sqrt(dot(along, along));
        direction = scale(along, hn::Div(splat(1.0f), length));
        const Vf facing = hn::Neg(dot(direction, shading_normal));
        const Mf faces = hn::Gt(facing, zero);
        normal = select(faces, shading_normal, geometric);
        cosine = hn::IfThenElse(faces, facing, hn::Neg(dot(direction, geometric)));
        cosine = hn::Min(hn::Max(cosine, zero), splat(1.0f));
    }

    // As long as the ray's own direction, on the ray's side of the triangle.
    HWY_INLINE V3 mirrored() const {
        const V3 out = add(direction, scale(normal, hn::Add(cosine, cosine)));
        const Vf up = hn::Min(dot(out, geometric), hn::Zero(kF));
        return scale(subtract(out, scale(geometric, hn::Add(up, up))), length);
    }

    // ... on the other side.
    HWY_INLINE V3 bent(Vf eta, const Refraction& refraction) const {
        const Vf along_normal = hn::Sub(hn::Mul(eta, cosine), refraction.cosine_beyond);
        const V3 out = add(scale(direction, eta), scale(normal, along_normal));
        const Vf up = hn::Max(dot(out, geometric), hn::Zero(kF));
        return scale(subtract(out, scale(geometric, hn::Add(up, up))), length);
    }
};

// exp(-x) for x >= 0, to 1e-5 of it; 0 from 87 on.
HWY_INLINE Vf exp_of_minus(Vf x) {
    const Vf y = hn::Mul(x, splat(-1.44269504f));
    const Mf shows = hn::Gt(y, splat(-126.0f));
    const Vf clamped = hn::IfThenElseZero(shows, y);
    const Vf whole = hn::Floor(hn::Add(clamped, splat(0.5f)));
    const Vf part = hn::Mul(hn::Sub(clamped, whole), splat(0.69314718f)); // -0.35 to 0.35
    Vf sum = splat(1.0f / 720);
    for (const float factor : {1.0f / 120, 1.0f / 24, 1.0f / 6, 1.0f / 2, 1.0f, 1.0f})
        sum = hn::Add(hn::Mul(sum, part), splat(factor));
    const hn::Rebind<int32_t, Df> integer;
    const auto exponent =
        hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(integer, whole), hn::Set(integer, 127)));
    return hn::IfThenElseZero(shows, hn::Mul(sum, hn::BitCast(kF, exponent)));
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
