#include "materials.h"

#include <algorithm>
#include <cmath>

#include "textures.h"
#include "value.h"

namespace host::gltf {

namespace {

constexpr float dielectric_reflectance = 0.04f; // glTF 2.0, appendix B.2
constexpr float fallback_roughness = 0.7f;

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

// The engine's highlight is not normalised: a wide lobe at full reflectance would flood the
// surface with light, so rough ones fade.
float highlight_strength(float roughness) {
    return 1.0f - 0.8f * std::min(roughness, 1.0f);
}

void apply_metallic_roughness(const tinygltf::PbrMetallicRoughness& source, Material& material,
                              Notes& notes) {
    float metallic = std::min(to_factor(source.metallicFactor), 1.0f);
    float roughness = std::min(to_factor(source.roughnessFactor), 1.0f);
    if (source.metallicRoughnessTexture.index >= 0) {
        // Its factors default to 1 and mean nothing without it: all would be metal.
        notes.add("metallic-roughness textures are ignored: such surfaces are rough and not metal");
        metallic = 0.0f;
        roughness = fallback_roughness;
    }
    const glm::vec3 base(material.base_color);
    material.specular =
        glm::mix(glm::vec3(dielectric_reflectance), base, metallic) * highlight_strength(roughness);
    material.shininess = to_shininess(roughness);
    // Not to black: there is nothing around that a metal could mirror.
    material.base_color = glm::vec4(base * (1.0f - 0.5f * metallic), material.base_color.a);
}

void apply_alpha(const tinygltf::Material& source, Material& material, Notes& notes) {
    material.masked = source.alphaMode != "OPAQUE";
    material.alpha_cutoff = source.alphaMode == "MASK" ? to_factor(source.alphaCutoff) : 0.5f;
    if (source.alphaMode == "BLEND")
        notes.add("blended materials are masked at an alpha of 0.5 instead");
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
    material.emissive = glm::vec3(material.base_color);
    material.emissive_texture = material.base_color_texture;
    material.base_color = glm::vec4(0.0f, 0.0f, 0.0f, material.base_color.a);
    if (!material.masked) material.base_color_texture = {};
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
    apply_alpha(source, material, notes);
    if (source.occlusionTexture.index >= 0) notes.add("occlusion textures are ignored");
    if (find_extension(source.extensions, "KHR_materials_unlit")) {
        make_unlit(material);
        return material;
    }
    apply_metallic_roughness(pbr, material, notes);
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
