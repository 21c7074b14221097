#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "document.h"

// Buffers and images are read here: tinygltf wants files exactly as long as they are declared,
// decodes + as a space and knows seven media types.
namespace host::gltf {

// `bin` is the chunk of a .glb. Buffers without a URI are legal as long as nothing uses them.
// Throws InputError, naming the buffer, for one that cannot be read.
std::vector<Buffer> read_buffers(const nlohmann::json& root, std::optional<std::string_view> bin,
                                 Resources& resources);

// Those that cannot be read say why.
std::vector<ImageSource> read_images(const nlohmann::json& root, Resources& resources);

} // namespace host::gltf
