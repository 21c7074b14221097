// How rough, metallic and hidden surfaces are, by textures. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_WEAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_WEAR_INL_H
#undef PEREGRINE_SHADE_WEAR_INL_H
#else
#define PEREGRINE_SHADE_WEAR_INL_H
#endif

#include "shade/material/roughness.h"
#include "shade/surface/runs-inl.h"
#include "shade/surface/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

HWY_INLINE Vf clamp(Vf x, float least, float most) {
    return hn::Min(hn::Max(x, splat(least)), splat(most));
}

// The forms of material/roughness.h.
HWY_INLINE Vf shininess_of(Vf roughness) {
    const Vf r = hn::Max(roughness, splat(kLeastRoughness));
    const Vf square = hn::Mul(r, r);
    const Vf n = hn::Sub(hn::Div(splat(2.0f), hn::Mul(square, square)), splat(2.0f));
    return clamp(n, 1.0f, kMostShininess);
}

HWY_INLINE Vf gain_of(Vf roughness, const float* gains) {
    constexpr float kScale = float(GainTable::kCells) / (1.0f - kLeastRoughness);
    const Vf at = clamp(hn::Mul(hn::Sub(roughness, splat(kLeastRoughness)), splat(kScale)), 0.0f,
                        float(GainTable::kCells));
    const Vf cell = hn::Min(hn::Floor(at), splat(float(GainTable::kCells - 1)));
    const Vi index = hn::ConvertTo(kI, cell);
    const Vf low = hn::GatherIndex(kF, gains, index);
    const Vf high = hn::GatherIndex(kF, gains + 1, index);
    return hn::Add(low, hn::Mul(hn::Sub(high, low), hn::Sub(at, cell)));
}

// The colours of neighbouring rays that see one material are known; metals lose part of theirs.
HWY_INLINE void shine(const scene::Material& material, uint32_t features, uint32_t i, Vf roughness,
                      Vf metalness, const float* gains, Surface& out) {
    const V3 albedo = load(out.albedo, i);
    if (features & scene::kSpecular) {
        const V3 other = splat(material.specular);
        const V3 reflectance = add(other, scale(subtract(albedo, other), metalness));
        const Vf fade = hn::Sub(splat(1.0f), hn::Mul(splat(kRoughnessFade), roughness));
        store(scale(reflectance, hn::Mul(fade, gain_of(roughness, gains))), out.specular, i);
    }
    const Vf left = hn::Sub(splat(1.0f), hn::Mul(splat(kMetalLoss), metalness));
    store(scale(albedo, left), out.albedo, i);
}

HWY_INLINE void hide(float strength, uint32_t i, Vf red, Surface& out) {
    const Vf one = splat(1.0f);
    const Vf part = hn::Sub(clamp(red, 0.0f, 1.0f), one);
    hn::StoreU(hn::Add(one, hn::Mul(splat(strength), part)), kF, out.occlusion + i);
}

// Of one image for both, which is sampled once.
HWY_INLINE bool has_both(const MaterialLook& look) {
    return look.roughness.texture && look.roughness.texture == look.occlusion.texture
           && look.roughness.place == look.occlusion.place;
}

template <SurfacePart Part>
HWY_INLINE void find_roughness(const MaterialLook& look, uint32_t features, bool by_footprint,
                               Run span, Surface& out) {
    const scene::Material& material = *look.material;
    const float* const gains = gain_table().gain;
    const Vf roughness = splat(material.roughness), metalness = splat(material.metalness);
    const bool hides = has_both(look);
    sample_texture(look.roughness, out, by_footprint, span,
                   [&](uint32_t i, const V3& texel, Vf) HWY_ATTR {
                       const Vf rough = clamp(hn::Mul(texel.y, roughness), 0.0f, 1.0f);
                       if constexpr (Part != SurfacePart::colors)
                           if (features & scene::kSpecular)
                               hn::StoreU(shininess_of(rough), kF, out.shininess + i);
                       if constexpr (Part == SurfacePart::geometry) return;
                       shine(material, features, i, rough,
                             clamp(hn::Mul(texel.z, metalness), 0.0f, 1.0f), gains, out);
                       if (hides) hide(material.occlusion_strength, i, texel.x, out);
                   });
}

HWY_INLINE void find_occlusion(const MaterialLook& look, bool by_footprint, Run span,
                               Surface& out) {
    if (!look.occlusion.texture) return fill(1.0f, span, out.occlusion);
    sample_texture(look.occlusion, out, by_footprint, span,
                   [&](uint32_t i, const V3& texel, Vf)
                       HWY_ATTR { hide(look.material->occlusion_strength, i, texel.x, out); });
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
