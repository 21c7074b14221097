// What rays see that hit nothing. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_SKY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_SKY_INL_H
#undef PEREGRINE_SHADE_SKY_INL_H
#else
#define PEREGRINE_SHADE_SKY_INL_H
#endif

#include "scene/sky.h"
#include "shade/surface/ray_hits.h"
#include "shade/surface/texels-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

inline constexpr float kPi = 3.14159265f;

// To 1e-7 radians or so; the polynomial is 4.4.49 of Abramowitz and Stegun, "Handbook of
// Mathematical Functions", 1964.
HWY_INLINE Vf angle_of(Vf y, Vf x) {
    const Vf across = hn::Abs(x), along = hn::Abs(y);
    const Vf larger = hn::Max(hn::Max(across, along), splat(1e-30f));
    const Vf ratio = hn::Div(hn::Min(across, along), larger);
    const Vf square = hn::Mul(ratio, ratio);
    Vf sum = splat(0.0028662257f);
    for (const float factor : {-0.0161657367f, 0.0429096138f, -0.0752896400f, 0.1065626393f,
                               -0.1420889944f, 0.1999355085f, -0.3333314528f, 1.0f})
        sum = hn::Add(hn::Mul(sum, square), splat(factor));
    Vf angle = hn::Mul(sum, ratio);
    angle = hn::IfThenElse(hn::Gt(along, across), hn::Sub(splat(0.5f * kPi), angle), angle);
    angle = hn::IfThenElse(hn::Lt(x, hn::Zero(kF)), hn::Sub(splat(kPi), angle), angle);
    return hn::CopySign(angle, y);
}

HWY_INLINE V3 mix(const V3& a, const math::Vec3& b, Vf weight) {
    return add(a, scale(subtract(splat(b), a), weight));
}

// `height`: the sine of the elevation. Fades fast from the horizon on, upward and downward.
HWY_INLINE V3 gradient(const scene::Sky& sky, Vf height) {
    const Vf zero = hn::Zero(kF), one = splat(1.0f);
    const Vf up = hn::Max(height, zero), down = hn::Max(hn::Neg(height), zero);
    const V3 above = mix(splat(sky.horizon), sky.zenith, hn::Mul(up, hn::Sub(splat(2.0f), up)));
    return mix(above, sky.ground, hn::Min(hn::Mul(down, splat(8.0f)), one));
}

// An equirectangular image: its level whose texels are about as wide as a pixel.
class SkyImage {
public:
    HWY_INLINE SkyImage(const scene::Texture& texture, float pixel) : texture_(texture) {
        float texels = pixel * float(texture.width) * (0.5f / kPi);
        for (; texels >= 2 && level_ + 1 < texture.level_count; texels *= 0.5f) ++level_;
    }

    // `direction` of any length.
    HWY_INLINE V3 at(const V3& direction) const {
        const Vf flat =
            hn::Sqrt(hn::Add(hn::Mul(direction.x, direction.x), hn::Mul(direction.z, direction.z)));
        const Vf half = splat(0.5f);
        const Vf u =
            hn::Add(half, hn::Mul(angle_of(direction.x, hn::Neg(direction.z)), splat(0.5f / kPi)));
        const Vf v = hn::Sub(half, hn::Mul(angle_of(direction.y, flat), splat(1.0f / kPi)));
        const auto first = int32_t(texture_.level_first[level_]);
        const auto width = int32_t(texture_.level_width(level_));
        const auto height = int32_t(texture_.level_height(level_));
        const float edge = 0.5f / float(height); // poles are no neighbours
        TexelAddresses addresses{};
        find_texels(texture_,
                    VectorLevel(hn::Set(kI, first), hn::Set(kI, width), hn::Set(kI, height)), u,
                    hn::Min(hn::Max(v, splat(edge)), splat(1.0f - edge)), addresses);
        HWY_ALIGN float rgba[4 * HWY_LANES(float)];
        if (texture_.storage == scene::Texture::Storage::unorm16)
            fetch_samples<uint16_t>(texture_, addresses, kLanes, rgba);
        else
            fetch_samples<float>(texture_, addresses, kLanes, rgba);
        V3 color;
        Vf alpha;
        hn::LoadInterleaved4(kF, rgba, color.x, color.y, color.z, alpha);
        return scale(color, splat(scene::texel_scale(texture_)));
    }

private:
    const scene::Texture& texture_;
    uint32_t level_ = 0;
};

template <class ColorOf>
HWY_INLINE void paint_misses(const scene::Sky& sky, const RayHits& hits, float* const radiance[3],
                             const ColorOf& color_of) {
    const Vf cosine = splat(sky.cosine), sine = splat(sky.sine), intensity = splat(sky.intensity);
    for (uint32_t i = 0; i < hits.count; i += kLanes) {
        const Mf missed = hn::RebindMask(
            kF, hn::Eq(hn::LoadU(kU, hits.triangle + i), hn::Set(kU, geometry::kNoTriangle)));
        const Mf wanted = hn::And(missed, hn::FirstN(kF, hits.count - i));
        if (hn::AllFalse(kF, wanted)) continue;
        const Vf x = hn::LoadU(kF, hits.direction[0] + i), z = hn::LoadU(kF, hits.direction[2] + i);
        const V3 turned{hn::Sub(hn::Mul(cosine, x), hn::Mul(sine, z)),
                        hn::LoadU(kF, hits.direction[1] + i),
                        hn::Add(hn::Mul(sine, x), hn::Mul(cosine, z))};
        const V3 color = scale(color_of(turned), intensity);
        hn::BlendedStore(color.x, wanted, kF, radiance[0] + i);
        hn::BlendedStore(color.y, wanted, kF, radiance[1] + i);
        hn::BlendedStore(color.z, wanted, kF, radiance[2] + i);
    }
}

HWY_ATTR void paint_sky(const scene::Sky& sky, const RayHits& hits, float* const radiance[3]) {
    if (sky.kind == scene::SkyKind::gradient)
        return paint_misses(sky, hits, radiance, [&](const V3& direction) HWY_ATTR {
            const Vf length = hn::Sqrt(dot(direction, direction));
            return gradient(sky, hn::Div(direction.y, length));
        });
    const SkyImage image(*sky.texture, hits.footprint);
    paint_misses(sky, hits, radiance,
                 [&](const V3& direction) HWY_ATTR { return image.at(direction); });
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
