#pragma once

#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "notes.h"

namespace host::gltf {

// The extensions that a document declares or holds, whether required or not.
std::set<std::string> find_extensions(const nlohmann::json& root);

// Throws InputError, naming them, if the document requires extensions that are not supported.
void check_required_extensions(const nlohmann::json& root);

// Notes each of `extensions` that is not supported.
void note_ignored(const std::set<std::string>& extensions, Notes& notes);

} // namespace host::gltf
