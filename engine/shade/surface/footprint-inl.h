// What a ray's pixel covers of a texture. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_FOOTPRINT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_FOOTPRINT_INL_H
#undef PEREGRINE_SHADE_FOOTPRINT_INL_H
#else
#define PEREGRINE_SHADE_FOOTPRINT_INL_H
#endif

#include "shade/surface/ray_hits.h"
#include "shade/surface/triangle_shading.h"
#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// An ellipse as the matrix whose eigenvalues are the squares of its axes.
struct Ellipse {
    Vf xx, xy, yy;
};

// Gradients of a triangle's barycentrics, and their products.
struct BarycentricGradients {
    math::Vec3 u, v;
    float uu, uv, vv;

    explicit BarycentricGradients(const TriangleShading& triangle) {
        const math::Vec3& n = triangle.geometric;
        const math::Vec3 side1 = triangle.vertex[1] - triangle.vertex[0];
        const math::Vec3 side2 = triangle.vertex[2] - triangle.vertex[0];
        const math::Vec3 across = glm::cross(side2, n);
        const float scale = 1.0f / glm::dot(across, side1); // twice the area
        u = across * scale;
        v = glm::cross(n, side1) * scale;
        uu = glm::dot(u, u);
        uv = glm::dot(u, v);
        vv = glm::dot(v, v);
    }
};

// A cone about the ray cuts the triangle's plane in an ellipse: as wide as the cone is there, and
// 1 / cosine longer in the direction in which the ray leans. In barycentrics, with their gradients
// G, the direction d and the unit normal n, that is
//     width^2 (G G' + (G d) (G d)' / (n . d)^2)
// which knows no special case for rays that meet the plane head on.
HWY_INLINE Ellipse footprint(const BarycentricGradients& gradients, const math::Vec3& normal,
                             const RayHits& hits, uint32_t i) {
    const V3 d{hn::LoadU(kF, hits.direction[0] + i), hn::LoadU(kF, hits.direction[1] + i),
               hn::LoadU(kF, hits.direction[2] + i)};
    const Vf width = hn::Mul(hn::LoadU(kF, hits.t + i), splat(hits.footprint));
    const Vf across = hn::Div(width, dot(d, splat(normal)));
    const Vf u = hn::Mul(dot(d, splat(gradients.u)), across);
    const Vf v = hn::Mul(dot(d, splat(gradients.v)), across);
    const Vf square = hn::Mul(width, width);
    return {hn::Add(hn::Mul(square, splat(gradients.uu)), hn::Mul(u, u)),
            hn::Add(hn::Mul(square, splat(gradients.uv)), hn::Mul(u, v)),
            hn::Add(hn::Mul(square, splat(gradients.vv)), hn::Mul(v, v))};
}

// The ellipse in texture coordinates, which change by `side1` and `side2` along the triangle's
// sides.
HWY_INLINE Ellipse in_coordinates(const Ellipse& e, const math::Vec2& side1,
                                  const math::Vec2& side2) {
    const auto product = [&](float a1, float a2, float b1, float b2) HWY_ATTR {
        return hn::Add(hn::Add(hn::Mul(e.xx, splat(a1 * b1)), hn::Mul(e.yy, splat(a2 * b2))),
                       hn::Mul(e.xy, splat(a1 * b2 + a2 * b1)));
    };
    return {product(side1.x, side2.x, side1.x, side2.x),
            product(side1.x, side2.x, side1.y, side2.y),
            product(side1.y, side2.y, side1.y, side2.y)};
}

// Which texels stand for a footprint: so many samples in a row along its longer axis, each from a
// level whose texels are about as wide as its shorter one.
struct LevelChoice {
    Vf level;          // 0 is the finest; whole numbers and what lies between
    Vf taps;           // 1 to kMostTaps
    Vf part;           // 1 / taps
    Vf step_x, step_y; // from tap to tap, in texels of the finest level
};

inline constexpr uint32_t kMostTaps = 4;

// Bilinear samples reach over two texels, and so may take them from a level half a step finer than
// one texel a pixel asks for: docs/rendering.md has what that gives. Squares of the axes, as seen
// from there.
inline constexpr float kSharpness = 0.5f;

// As long as no axis is longer than a texel, the finest level is right as it is, and choose_level
// says the same.
HWY_INLINE bool all_are_small(const Ellipse& e, Mf active) {
    const Vf sum = hn::Add(e.xx, e.yy);
    return hn::AllTrue(kF, hn::Or(hn::Not(active), hn::Le(sum, splat(1.0f / kSharpness))));
}

HWY_INLINE LevelChoice finest_choice() {
    const Vf zero = hn::Zero(kF);
    return {zero, splat(1.0f), splat(1.0f), zero, zero};
}

// log2 of a positive number; between powers of two a straight line, which is off by 0.09 at most.
HWY_INLINE Vf rough_log2(Vf x) {
    const Vi bits = hn::Sub(hn::BitCast(kI, x), hn::Set(kI, 127 << 23));
    return hn::Mul(hn::ConvertTo(kF, bits), splat(0x1p-23f));
}

struct TapCount {
    Vf taps, part; // and 1 / taps
};

// How many times the shorter axis goes into the longer one, generously: both are squares.
HWY_INLINE TapCount count_taps(Vf longer, Vf shorter) {
    TapCount count{splat(1.0f), splat(1.0f)};
    for (uint32_t k = 1; k < kMostTaps; ++k) {
        const Mf more = hn::Gt(longer, hn::Mul(shorter, splat(2.0f * float(k * k))));
        count.taps = hn::IfThenElse(more, splat(float(k + 1)), count.taps);
        count.part = hn::IfThenElse(more, splat(1.0f / float(k + 1)), count.part);
    }
    return count;
}

HWY_INLINE LevelChoice choose_level(const Ellipse& e, float last_level) {
    const Vf one = splat(1.0f);
    // Not of what is huge or no number: the coarsest level is right for that.
    const Mf usable = hn::Lt(hn::Add(e.xx, e.yy), splat(1e12f));
    const Vf half = splat(0.5f * kSharpness);
    const Vf mean = hn::Mul(half, hn::Add(e.xx, e.yy)), lean = hn::Mul(half, hn::Sub(e.xx, e.yy));
    const Vf cross = hn::Mul(splat(kSharpness), e.xy);
    const Vf root = hn::Sqrt(hn::Add(hn::Mul(lean, lean), hn::Mul(cross, cross)));
    const Vf longer = hn::Add(mean, root);
    const Vf product = hn::Mul(hn::Add(mean, lean), hn::Sub(mean, lean));
    Vf shorter = hn::Div(hn::Sub(product, hn::Mul(cross, cross)), longer);
    shorter = hn::IfThenElse(hn::Gt(shorter, one), shorter, one);
    const TapCount count = count_taps(longer, shorter);
    const Vf spread = hn::Mul(longer, hn::Mul(count.part, count.part));
    const Vf width = hn::IfThenElse(hn::Gt(spread, shorter), spread, shorter);
    const Vf last = splat(last_level);
    Vf level = hn::Mul(splat(0.5f), rough_log2(width));
    level = hn::IfThenElse(hn::And(usable, hn::Lt(level, last)), level, last);
    const Mf many = hn::And(usable, hn::Gt(count.taps, one));
    const Vf zero = hn::Zero(kF);
    if (hn::AllFalse(kF, many)) return {level, one, one, zero, zero};
    // The longer axis as an eigenvector: of its two forms the one that does not cancel.
    const Mf is_wide = hn::Ge(lean, zero);
    const Vf x = hn::IfThenElse(is_wide, hn::Add(root, lean), cross);
    const Vf y = hn::IfThenElse(is_wide, cross, hn::Sub(root, lean));
    const Vf square = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), splat(1e-30f)); // never 0
    const Vf scale = hn::Sqrt(hn::Div(hn::Mul(spread, splat(1.0f / kSharpness)), square));
    return {level, hn::IfThenElse(many, count.taps, one), hn::IfThenElse(many, count.part, one),
            hn::IfThenElseZero(many, hn::Mul(x, scale)),
            hn::IfThenElseZero(many, hn::Mul(y, scale))};
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
