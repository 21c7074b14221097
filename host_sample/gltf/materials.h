#pragma once

#include "../level.h"
#include "document.h"
#include "notes.h"

namespace host::gltf {

// Fills level.materials (by the file's numbers), textures and images.
void import_materials(const Document& document, Level& level, Notes& notes);

} // namespace host::gltf
