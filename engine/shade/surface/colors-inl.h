// What hits look like. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_COLORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_COLORS_INL_H
#undef PEREGRINE_SHADE_COLORS_INL_H
#else
#define PEREGRINE_SHADE_COLORS_INL_H
#endif

#include "shade/surface/runs-inl.h"
#include "shade/surface/sample-inl.h"
#include "shade/surface/triangle_shading.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

HWY_INLINE void find_colors(const TriangleShading& triangle, uint32_t features, const RayHits& hits,
                            Run run, Surface& out) {
    const scene::Material& material = *triangle.material;
    const math::Vec3 base(material.base_color);
    if (triangle.base_color.texture)
        sample_texture(triangle, triangle.base_color, hits, run,
                       [&](uint32_t i, const V3& texel) HWY_ATTR {
                           const V3 tint = splat(base);
                           store({hn::Mul(texel.x, tint.x), hn::Mul(texel.y, tint.y),
                                  hn::Mul(texel.z, tint.z)},
                                 out.albedo, i);
                       });
    else
        fill(base, run, out.albedo);
    if (features & scene::kSpecular)
        fill(material.specular * triangle.highlight_gain, run, out.specular);
    if (!(features & scene::kEmissive)) return;
    if (triangle.emissive.texture)
        sample_texture(triangle, triangle.emissive, hits, run,
                       [&](uint32_t i, const V3& texel) HWY_ATTR {
                           const V3 tint = splat(material.emissive);
                           store({hn::Mul(texel.x, tint.x), hn::Mul(texel.y, tint.y),
                                  hn::Mul(texel.z, tint.z)},
                                 out.emissive, i);
                       });
    else
        fill(material.emissive, run, out.emissive);
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
