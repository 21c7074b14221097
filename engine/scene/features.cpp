#include "scene/features.h"

#include "scene/snapshot.h"

namespace peregrine::scene {
namespace {

uint32_t features_of(const Material& material) {
    uint32_t features = material.masked ? uint32_t(kAlphaMask) : 0;
    if (!material.double_sided) features |= kSingleSidedMaterials;
    if (material.base_color_texture.texture) features |= kTextures;
    if (material.normal_texture.texture) features |= kNormalMaps | kTextures;
    if (material.emissive_texture.texture) features |= kTextures;
    if (material.emissive != math::Vec3(0)) features |= kEmissive;
    if (material.specular != math::Vec3(0)) features |= kSpecular;
    return features;
}

} // namespace

uint32_t features_of(const Snapshot& snapshot) {
    uint32_t features = 0;
    for (const Snapshot::Mesh& mesh : snapshot.meshes) {
        if (!mesh.data) continue;
        if (mesh.dynamic) features |= kDynamicMeshes;
        if (mesh.materials.empty()) features |= features_of(snapshot.materials[mesh.material]);
        for (const uint32_t material : mesh.materials)
            features |= features_of(snapshot.materials[material]);
    }
    for (const Light& light : snapshot.lights)
        features |= kLights | (light.casts_shadow ? uint32_t(kShadows) : 0);
    return features;
}

} // namespace peregrine::scene
