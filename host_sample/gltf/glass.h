#pragma once

#include "../level.h"
#include "notes.h"

#include <tiny_gltf.h>

// What of a glTF material the engine's frames follow rays for.
namespace host::gltf {

struct Surface {
    float metallic, roughness; // 0 to 1
};

// How much of a surface's reflectance is a sharp mirror: all of it if it is smooth, and less up to
// a roughness of 0.25 (metals) or 0.1 (the rest), from where on only highlights are left.
float find_polish(const Surface& surface);

// Mirrors so much head on.
void mirror(const glm::vec3& reflectance, Material& material);

// The reflectance of what is not metal: KHR_materials_ior, KHR_materials_specular.
glm::vec3 read_dielectric(const tinygltf::ExtensionMap& extensions, Notes& notes);

// KHR_materials_transmission, KHR_materials_volume.
void apply_transmission(const tinygltf::ExtensionMap& extensions, const Surface& surface,
                        Material& material, Notes& notes);

} // namespace host::gltf
