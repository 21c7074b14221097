#pragma once

#include <tiny_gltf.h>

#include "../level.h"
#include "notes.h"

namespace host::gltf {

// Fills level.materials (by the file's numbers), textures and images.
void import_materials(const tinygltf::Model& model, Level& level, Notes& notes);

} // namespace host::gltf
