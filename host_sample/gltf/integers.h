#pragma once

#include <nlohmann/json.hpp>

namespace host::gltf {

// glTF 2.0, 2.7: an integer may be written as 3.0 or 3e0, but not with a fraction. tinygltf takes 3
// alone, and drops or wraps what it does not take. Rewrites the core's integers as it wants them.
// Throws InputError, naming the property, where there is a fraction, or a number that is out of
// range.
void settle_integers(nlohmann::json& root);

} // namespace host::gltf
