#include "node_names.h"

#include <charconv>

namespace host::game {

namespace {

// Reads a word, or a number of at most six digits, and moves on.
bool take(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
}

bool take(std::string_view& text, uint32_t& number) {
    const char* begin = text.data();
    const auto [end, error] = std::from_chars(begin, begin + text.size(), number);
    const auto length = static_cast<size_t>(end - begin);
    if (error != std::errc() || length > 6) return false;
    text.remove_prefix(length);
    return true;
}

std::optional<NodeName> numbered(std::string_view text, Role role) {
    NodeName name{role};
    if (!take(text, name.number)) return std::nullopt;
    if (role == Role::lift && text == "_top") return NodeName{Role::lift_top, name.number};
    if (role == Role::gate && text == "_exit") return NodeName{Role::gate_exit, name.number};
    if (role == Role::patrol && !(take(text, "_") && take(text, name.step))) return std::nullopt;
    if (!text.empty()) return std::nullopt;
    return name;
}

std::optional<NodeName> leaf(std::string_view text, uint32_t side) {
    auto name = numbered(text, Role::door);
    if (name) name->number = 2 * name->number + side;
    return name;
}

} // namespace

std::optional<NodeName> parse_node_name(std::string_view name) {
    if (take(name, "door_left_")) return leaf(name, 0);
    if (take(name, "door_right_")) return leaf(name, 1);
    if (take(name, "lift_")) return numbered(name, Role::lift);
    if (take(name, "gate_")) return numbered(name, Role::gate);
    if (take(name, "crate_")) return numbered(name, Role::crate);
    if (take(name, "core_")) return numbered(name, Role::core);
    if (take(name, "patrol_")) return numbered(name, Role::patrol);
    if (take(name, "spawn_")) return numbered(name, Role::spawn);
    return std::nullopt;
}

bool is_moved(const std::string& name) {
    const auto parsed = parse_node_name(name);
    return parsed && parsed->role <= Role::crate;
}

} // namespace host::game
