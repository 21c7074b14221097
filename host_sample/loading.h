#pragma once

#include <functional>
#include <string>

#include "gltf/import.h"
#include "options.h"

namespace host {

// The options' level, with a light if it has none; notes go to the user. Throws InputError.
Level load_level(const Options& options, const std::string& animation,
                 const gltf::NodeFilter& moved = {});

} // namespace host
