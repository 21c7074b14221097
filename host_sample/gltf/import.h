#pragma once

#include <filesystem>
#include <string>

#include "../level.h"

namespace host::gltf {

// Reads a .gltf or .glb file. Throws InputError with a sentence that names the file and the cause;
// any file is either imported or refused, whatever its bytes.
Level import_file(const std::filesystem::path& path);

// The same from memory, under a name for the sentences.
Level import_bytes(const std::string& bytes, const std::string& name);

} // namespace host::gltf
