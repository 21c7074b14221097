// Mappings of the player's own, for pads whose buttons are numbered in an unusual way.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace host::pads {

// Vendor and product, and a text for apply_mapping_text (mapping.h).
using PlayerMappings = std::map<std::pair<uint16_t, uint16_t>, std::string>;

// Lines "vvvv:pppp south=2 right_x=z ..."; "#" begins a comment. Returns a sentence about the first
// mistake, and then leaves "mappings" as they are; empty: none.
std::string read_player_mappings(const std::string& file, PlayerMappings& mappings);
std::string parse_player_mappings(const std::string& text, PlayerMappings& mappings);

} // namespace host::pads
