#include "materials.h"

#include <algorithm>
#include <cmath>

#include "glass.h"
#include "textures.h"
#include "value.h"

namespace host::gltf {

namespace {

glm::vec3 read_color(const std::vector<double>& values, glm::vec3 otherwise) {
    if (values.size() < 3) return otherwise;
    return {to_factor(values[0]), to_factor(values[1]), to_factor(values[2])};
}

// The exponent whose lobe is as wide as a Beckmann distribution of the same roughness
// (Walter et al. 2007, section 5.1), alpha being the square of glTF's roughness.
float to_shininess(float roughness) {
    const float alpha = std::max(roughness * roughness, 1e-3f);
    return std::clamp(2.0f / (alpha * alpha) - 2.0f, 1.0f, 512.0f);
}

// A wide lobe at full reflectance would flood the surface with light, so rough ones fade. The
// engine does the same with textures.
float highlight_strength(float roughness) {
    return 1.0f - 0.8f * std::min(roughness, 1.0f);
}

// What is metal or rough in the mean: mirrors and glass have no textures.
Surface read_surface(const Textures& textures, const Material& material) {
    const glm::vec3 mean = textures.mean(material.roughness_texture);
    return {material.metalness * mean.z, material.roughness * mean.y};
}

void apply_roughness_texture(const tinygltf::PbrMetallicRoughness& source, Textures& textures,
                             Material& material) {
    const tinygltf::TextureInfo& texture = source.metallicRoughnessTexture;
    material.roughness_texture =
        textures.use(texture.index, texture.texCoord, texture.extensions, false);
    material.metalness = std::min(to_factor(source.metallicFactor), 1.0f);
    material.roughness = std::min(to_factor(source.roughnessFactor), 1.0f);
}

void apply_metallic_roughness(const Surface& surface, const glm::vec3& dielectric,
                              Material& material) {
    const auto [metallic, roughness] = surface;
    const glm::vec3 base(material.base_color);
    const glm::vec3 reflectance = glm::mix(dielectric, base, metallic);
    const float polish = find_polish(surface);
    mirror(reflectance * polish, material);
    if (material.roughness_texture.texture != no_index) {
        material.specular = dielectric; // the engine does the rest, texel by texel
        return;
    }
    material.specular = reflectance * highlight_strength(roughness);
    material.shininess = to_shininess(roughness);
    // Not to black where it mirrors nothing.
    const float left = 1.0f - glm::mix(0.5f, 1.0f, polish) * metallic;
    material.base_color = glm::vec4(base * left, material.base_color.a);
}

void apply_occlusion(const tinygltf::OcclusionTextureInfo& source, Textures& textures,
                     Material& material) {
    material.occlusion_strength = std::min(to_factor(source.strength), 1.0f);
    if (material.occlusion_strength == 0.0f) return;
    material.occlusion_texture =
        textures.use(source.index, source.texCoord, source.extensions, false);
}

void apply_alpha(const tinygltf::Material& source, Material& material) {
    material.masked = source.alphaMode == "MASK";
    material.blended = source.alphaMode == "BLEND";
    if (material.masked) material.alpha_cutoff = to_factor(source.alphaCutoff);
}

void apply_emission(const tinygltf::Material& source, Textures& textures, Material& material) {
    double strength = 1.0;
    if (const auto* extension =
            find_extension(source.extensions, "KHR_materials_emissive_strength"))
        strength = read_number(*extension, "emissiveStrength").value_or(1.0);
    material.emissive = read_color(source.emissiveFactor, glm::vec3(0.0f)) * to_factor(strength);
    if (material.emissive == glm::vec3(0.0f)) return; // its texture would be multiplied away
    material.emissive_texture =
        textures.use(source.emissiveTexture.index, source.emissiveTexture.texCoord,
                     source.emissiveTexture.extensions, true);
}

// KHR_materials_unlit: the base colour, whatever the light.
void make_unlit(Material& material) {
    material.unlit = true;
    material.emissive = glm::vec3(material.base_color);
    material.emissive_texture = material.base_color_texture;
    material.base_color = glm::vec4(0.0f, 0.0f, 0.0f, material.base_color.a);
    if (!material.masked && !material.blended) material.base_color_texture = {};
    material.specular = glm::vec3(0.0f);
    material.shininess = 1.0f;
}

Material import_material(const tinygltf::Material& source, Textures& textures, Notes& notes) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Material material;
    material.name = source.name;
    material.double_sided = source.doubleSided;
    const auto& factor = pbr.baseColorFactor;
    material.base_color = glm::vec4(read_color(factor, glm::vec3(1.0f)),
                                    factor.size() > 3 ? to_factor(factor[3]) : 1.0f);
    material.base_color_texture =
        textures.use(pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord,
                     pbr.baseColorTexture.extensions, true);
    apply_alpha(source, material);
    if (find_extension(source.extensions, "KHR_materials_unlit")) {
        make_unlit(material);
        return material;
    }
    apply_occlusion(source.occlusionTexture, textures, material);
    apply_roughness_texture(pbr, textures, material);
    const Surface surface = read_surface(textures, material);
    apply_metallic_roughness(surface, read_dielectric(source.extensions, notes), material);
    apply_transmission(source.extensions, surface, material, notes);
    apply_emission(source, textures, material);
    const tinygltf::NormalTextureInfo& normal = source.normalTexture;
    material.normal_texture = textures.use(normal.index, normal.texCoord, normal.extensions, false);
    const auto scale = static_cast<float>(normal.scale);
    material.normal_scale = std::isfinite(scale) ? std::clamp(scale, -1e3f, 1e3f) : 1.0f;
    return material;
}

} // namespace

void import_materials(const Document& document, Level& level, Notes& notes) {
    Textures textures(document, level, notes);
    level.materials.reserve(document.model.materials.size());
    for (const tinygltf::Material& source : document.model.materials)
        level.materials.push_back(import_material(source, textures, notes));
}

} // namespace host::gltf
