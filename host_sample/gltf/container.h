#pragma once

#include <optional>
#include <string_view>

namespace host::gltf {

// The parts of a file: a .gltf is all JSON, a .glb has chunks (told apart by their content).
struct Container {
    std::string_view json;
    std::optional<std::string_view> bin; // nothing: there is no such chunk
};

// Chunks of other types are passed over (glTF 2.0, 4.4.3). Throws InputError.
Container open_container(std::string_view bytes);

} // namespace host::gltf
