#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

// The game knows what matters in a level by the names of the nodes: content/source/play.py.
namespace host::game {

enum class Role { door, lift, gate, crate, core, patrol, lift_top, gate_exit, spawn };

struct NodeName {
    Role role;
    uint32_t number = 0; // door_left_3 and door_right_3: 6 and 7
    uint32_t step = 0;   // patrol_2_5: 5
};

// Nothing for a name without a meaning.
std::optional<NodeName> parse_node_name(std::string_view name);

// Whether the game moves the mesh of a node with this name.
bool is_moved(const std::string& name);

} // namespace host::game
