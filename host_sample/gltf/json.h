#pragma once

#include <string_view>

#include <nlohmann/json.hpp>

namespace host::gltf {

// Parses the JSON of a document, which is then an object of glTF 2.0 whose integers are written as
// such. Throws InputError: malformed, nested too deeply, another version, a number where an integer
// belongs.
nlohmann::json parse_json(std::string_view text);

} // namespace host::gltf
