#include "glass.h"

#include <algorithm>
#include <cmath>

#include "value.h"

namespace host::gltf {

namespace {

constexpr double usual_index = 1.5;
constexpr double largest_index = 10; // the engine's

float to_share(double value) {
    return std::min(to_factor(value), 1.0f);
}

// 0 stands for a reflectance of 1, which the largest index comes near to.
double read_index(const tinygltf::ExtensionMap& extensions) {
    const auto* extension = find_extension(extensions, "KHR_materials_ior");
    if (!extension) return usual_index;
    const double index = read_number(*extension, "ior").value_or(usual_index);
    if (index == 0.0) return largest_index;
    return std::isfinite(index) ? std::clamp(index, 1.0, largest_index) : usual_index;
}

void note_texture(const tinygltf::Value& extension, const char* key, Notes& notes) {
    if (extension.Has(key))
        notes.add("textures of reflectance, transmission and thickness are ignored: their factors "
                  "hold everywhere");
}

} // namespace

float find_polish(const Surface& surface) {
    const float limit = glm::mix(0.1f, 0.25f, surface.metallic);
    return std::max(0.0f, 1.0f - surface.roughness / limit);
}

void mirror(const glm::vec3& reflectance, Material& material) {
    const float most = std::max({reflectance.x, reflectance.y, reflectance.z});
    if (!(most > 0.0f)) return;
    material.reflectivity = std::min(most, 1.0f);
    material.reflection_color = glm::min(reflectance / most, glm::vec3(1.0f));
}

glm::vec3 read_dielectric(const tinygltf::ExtensionMap& extensions, Notes& notes) {
    const double index = read_index(extensions);
    const double root = (index - 1.0) / (index + 1.0);
    glm::vec3 reflectance(static_cast<float>(root * root));
    if (const auto* extension = find_extension(extensions, "KHR_materials_specular")) {
        const float factor = to_share(read_number(*extension, "specularFactor").value_or(1.0));
        const glm::dvec3 color = read_triple(*extension, "specularColorFactor", glm::dvec3(1.0));
        for (int i = 0; i < 3; ++i)
            reflectance[i] = std::min(reflectance[i] * to_factor(color[i]), 1.0f) * factor;
        note_texture(*extension, "specularTexture", notes);
        note_texture(*extension, "specularColorTexture", notes);
    }
    return reflectance;
}

// A volume without a thickness is a sheet. What is thick is measured on its way through the mesh,
// not taken from the file.
void apply_transmission(const tinygltf::ExtensionMap& extensions, const Surface& surface,
                        Material& material, Notes& notes) {
    const auto* extension = find_extension(extensions, "KHR_materials_transmission");
    if (!extension) return;
    const float factor = to_share(read_number(*extension, "transmissionFactor").value_or(0.0));
    material.transmission = factor * (1.0f - surface.metallic);
    note_texture(*extension, "transmissionTexture", notes);
    if (!(material.transmission > 0.0f)) return;
    if (surface.roughness > 0.1f) notes.add("rough glass is as clear as smooth glass");
    material.index_of_refraction = static_cast<float>(read_index(extensions));
    if (surface.metallic == 0.0f) material.reflectivity = 0.0f; // it mirrors by its index
    const auto* volume = find_extension(extensions, "KHR_materials_volume");
    material.thin = !volume || !(read_number(*volume, "thicknessFactor").value_or(0.0) > 0.0);
    if (material.thin) return;
    note_texture(*volume, "thicknessTexture", notes);
    const glm::dvec3 color = read_triple(*volume, "attenuationColor", glm::dvec3(1.0));
    for (int i = 0; i < 3; ++i) material.attenuation_color[i] = to_share(color[i]);
    material.attenuation_distance =
        to_factor(read_number(*volume, "attenuationDistance").value_or(0.0));
}

} // namespace host::gltf
