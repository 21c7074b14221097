#include "scene/features.h"

#include "scene/fog.h"
#include "scene/light.h"
#include "scene/material.h"

namespace peregrine::scene {

uint32_t features_of(const Material& material) {
    uint32_t features = material.masked ? uint32_t(kAlphaMask) : 0;
    if (!material.shows_both_sides()) features |= kSingleSidedMaterials;
    if (material.base_color_texture.texture) features |= kTextures;
    if (material.normal_texture.texture) features |= kNormalMaps | kTextures;
    if (material.emissive_texture.texture) features |= kTextures;
    if (material.occlusion_texture.texture) features |= kOcclusionTextures | kTextures;
    if (material.roughness_texture.texture) features |= kRoughnessTextures | kTextures | kSpecular;
    if (material.emissive != math::Vec3(0)) features |= kEmissive;
    if (material.specular != math::Vec3(0)) features |= kSpecular;
    if (material.reflectivity > 0) features |= kReflection;
    if (material.transmission > 0) features |= kTransmission;
    if (material.blended) features |= kBlending;
    if (material.program != 0) features |= kPrograms;
    if (material.asks_rays) features |= kProgramRays;
    return features;
}

uint32_t features_of(const Light& light) {
    return kLights | (light.casts_shadow ? uint32_t(kShadows) : 0)
           | (light.fog_scatter > 0 ? uint32_t(kAirlight) : 0);
}

uint32_t features_of(const Environment& environment) {
    return environment.sky.kind == SkyKind::none ? 0 : uint32_t(kSky);
}

uint32_t features_of(const Fog& fog) {
    return fog.any() ? uint32_t(kFog) : 0;
}

} // namespace peregrine::scene
