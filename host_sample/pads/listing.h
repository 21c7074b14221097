#pragma once

#include <string>

#include "manager.h"

namespace host::pads {

// For people: which pads are there and how their controls are read. One paragraph a pad.
std::string list_pads(HidSource& source, const PlayerMappings& mappings = {});

} // namespace host::pads
