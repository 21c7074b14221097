// Pads whose buttons are numbered in a way that nothing in their descriptors tells.
#pragma once

#include <string_view>

#include "model.h"

namespace host::pads {

// A text for apply_mapping_text; empty for all others.
std::string_view known_mapping(const Identity& identity);

} // namespace host::pads
