#pragma once

#include <string_view>

// tinygltf trusts the file in a few places: chunk lengths, the depth of the JSON, and the number
// of buffers that copy the same bytes. These checks run before it sees the file.
namespace host::gltf {

bool is_binary_gltf(std::string_view bytes);

// Checks the chunks of a .glb and returns the JSON one. Throws InputError.
std::string_view check_container(std::string_view bytes);

// Throws InputError if the JSON is malformed, nested too deeply, or declares buffers that are not
// backed by distinct bytes.
void check_json(std::string_view json, bool binary);

} // namespace host::gltf
