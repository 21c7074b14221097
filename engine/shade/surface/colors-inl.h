// What hits look like. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_COLORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_COLORS_INL_H
#undef PEREGRINE_SHADE_COLORS_INL_H
#else
#define PEREGRINE_SHADE_COLORS_INL_H
#endif

#include "shade/surface/runs-inl.h"
#include "shade/surface/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

HWY_INLINE void tint(const MaterialLook::Sampled& sampled, const math::Vec3& color,
                     bool by_footprint, Run span, Surface& surface, Surface::Lanes* out) {
    if (!sampled.texture) return fill(color, span, out);
    sample_texture(sampled, surface, by_footprint, span,
                   [&](uint32_t i, const V3& texel, Vf)
                       HWY_ATTR { store(multiply(texel, splat(color)), out, i); });
}

// Of neighbouring rays that see one material.
HWY_INLINE void find_colors(const MaterialLook& look, uint32_t features, bool by_footprint,
                            Run span, Surface& out) {
    const scene::Material& material = *look.material;
    tint(look.color, math::Vec3(material.base_color), by_footprint, span, out, out.albedo);
    if (features & scene::kSpecular)
        fill(material.specular * look.highlight_gain, span, out.specular);
    if (features & scene::kEmissive)
        tint(look.emissive, material.emissive, by_footprint, span, out, out.emissive);
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
