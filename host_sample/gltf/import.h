#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "../level.h"

namespace host::gltf {

// An animation of the file by name, else by index; empty for all of them, or this for none:
// everything then stands still.
inline constexpr const char* no_animation = "none";

// By a node's name: whether the host moves it. Meshes at it and below it are then rigid, though no
// animation drives them.
using NodeFilter = std::function<bool(const std::string& name)>;

// Reads a .gltf or .glb file. Throws InputError with a sentence that names the file and the cause;
// any file is either imported or refused, whatever its bytes.
Level import_file(const std::filesystem::path& path, const std::string& animation = no_animation,
                  const NodeFilter& moved = {});

// The same from memory, under a name for the sentences.
Level import_bytes(const std::string& bytes, const std::string& name,
                   const std::string& animation = no_animation, const NodeFilter& moved = {});

} // namespace host::gltf
