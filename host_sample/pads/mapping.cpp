#include "mapping.h"

#include <algorithm>
#include <charconv>
#include <span>

namespace host::pads {

namespace {

constexpr std::array<const char*, button_count> button_names = {
    "south", "east",   "west",  "north",    "left_shoulder", "right_shoulder", "l2",
    "r2",    "select", "start", "guide",    "left_stick",    "right_stick",    "up",
    "down",  "left",   "right", "touchpad", "extra"};
constexpr std::array<const char*, axis_count> axis_names = {
    "left_x", "left_y", "right_x", "right_y", "left_trigger", "right_trigger"};

struct NamedUsage {
    const char* name;
    Usage usage;
};
constexpr NamedUsage usage_names[] = {{"x", usage::x},
                                      {"y", usage::y},
                                      {"z", usage::z},
                                      {"rx", usage::rx},
                                      {"ry", usage::ry},
                                      {"rz", usage::rz},
                                      {"brake", usage::brake},
                                      {"accelerator", usage::accelerator},
                                      {"slider", {usage::desktop, 0x36}},
                                      {"dial", {usage::desktop, 0x37}},
                                      {"throttle", {usage::simulation, 0xbb}},
                                      {"rudder", {usage::simulation, 0xba}},
                                      {"none", {}}};

std::span<const Button> numbered(ButtonOrder order) {
    using enum Button;
    static constexpr Button unused = static_cast<Button>(button_count);
    static constexpr Button direct_input[] = {
        west,          south,  east,  north,      left_shoulder, right_shoulder, left_trigger,
        right_trigger, select, start, left_stick, right_stick,   guide,          touchpad};
    static constexpr Button xbox[] = {south,         east,           west,   north,
                                      left_shoulder, right_shoulder, select, start,
                                      left_stick,    right_stick,    guide};
    static constexpr Button android[] = {south,        east,          unused,        west,
                                         north,        unused,        left_shoulder, right_shoulder,
                                         left_trigger, right_trigger, select,        start,
                                         guide,        left_stick,    right_stick,   extra};
    static constexpr Button nintendo[] = {
        east,          south,          unused,       north,         west,   unused,
        left_shoulder, right_shoulder, left_trigger, right_trigger, select, start,
        guide,         left_stick,     right_stick,  extra};
    switch (order) {
    case ButtonOrder::xbox:
        return xbox;
    case ButtonOrder::android:
        return android;
    case ButtonOrder::nintendo:
        return nintendo;
    default:
        return direct_input;
    }
}

ButtonOrder guess_order(const ReportDescriptor& descriptor, const Mapping& mapping) {
    const uint16_t buttons = highest_button(descriptor);
    if (buttons >= 15 || mapping[Axis::left_trigger] == usage::brake) return ButtonOrder::android;
    const bool triggers = mapping[Axis::left_trigger].page != 0;
    return triggers && (buttons == 10 || buttons == 11) ? ButtonOrder::xbox
                                                        : ButtonOrder::direct_input;
}

void map_axes(const ReportDescriptor& descriptor, Mapping& mapping) {
    const auto has = [&](Usage usage) { return descriptor.find(usage) != nullptr; };
    const auto take = [&](Axis axis, Usage usage) {
        if (has(usage)) mapping[axis] = usage;
    };
    take(Axis::left_x, usage::x);
    take(Axis::left_y, usage::y);
    const bool z_pair = has(usage::z) && has(usage::rz), r_pair = has(usage::rx) && has(usage::ry);
    // With both pairs the stick is the one that comes first: sticks precede triggers.
    const bool z_first =
        z_pair && (!r_pair || descriptor.find(usage::z)->bit < descriptor.find(usage::rx)->bit);
    if (z_first || r_pair) {
        mapping[Axis::right_x] = z_first ? usage::z : usage::rx;
        mapping[Axis::right_y] = z_first ? usage::rz : usage::ry;
    }
    if (has(usage::brake) && has(usage::accelerator)) {
        mapping[Axis::left_trigger] = usage::brake;
        mapping[Axis::right_trigger] = usage::accelerator;
    } else if (z_pair && r_pair) {
        mapping[Axis::left_trigger] = z_first ? usage::rx : usage::z;
        mapping[Axis::right_trigger] = z_first ? usage::ry : usage::rz;
    }
}

bool set_control(std::string_view name, std::string_view value, Mapping& mapping) {
    const auto button = std::find(button_names.begin(), button_names.end(), name);
    if (button != button_names.end()) {
        uint16_t number = 0;
        const auto [end, error] =
            std::from_chars(value.data(), value.data() + value.size(), number);
        if (error != std::errc() || end != value.data() + value.size()) return false;
        mapping.buttons[static_cast<size_t>(button - button_names.begin())] = number;
        return true;
    }
    const auto axis = std::find(axis_names.begin(), axis_names.end(), name);
    if (axis == axis_names.end()) return false;
    for (const NamedUsage& known : usage_names) {
        if (value != known.name) continue;
        mapping.axes[static_cast<size_t>(axis - axis_names.begin())] = known.usage;
        return true;
    }
    return false;
}

} // namespace

uint16_t highest_button(const ReportDescriptor& descriptor) {
    uint16_t highest = 0;
    for (const InputField& field : descriptor.inputs)
        if (field.usage.page == usage::button)
            highest = std::max(highest, static_cast<uint16_t>(field.usage.id + field.usages - 1));
    return highest;
}

Mapping default_mapping(const ReportDescriptor& descriptor, ButtonOrder order) {
    Mapping mapping;
    map_axes(descriptor, mapping);
    mapping.hat = descriptor.find(usage::hat) != nullptr;
    if (order == ButtonOrder::guess) order = guess_order(descriptor, mapping);
    const uint16_t highest = highest_button(descriptor);
    uint16_t number = 0;
    for (const Button button : numbered(order)) {
        ++number;
        if (static_cast<size_t>(button) < button_count && number <= highest)
            mapping[button] = number;
    }
    return mapping;
}

std::string apply_mapping_text(std::string_view text, Mapping& mapping) {
    constexpr std::string_view blanks = " \t\r\n,";
    Mapping changed = mapping;
    while (true) {
        const size_t begin = text.find_first_not_of(blanks);
        if (begin == std::string_view::npos) break;
        const std::string_view word = text.substr(begin, text.find_first_of(blanks, begin) - begin);
        text.remove_prefix(begin + word.size());
        const size_t equals = word.find('=');
        if (equals == std::string_view::npos
            || !set_control(word.substr(0, equals), word.substr(equals + 1), changed))
            return std::string(word).append(
                " maps nothing; write, for example, south=2 or right_x=z");
    }
    mapping = changed;
    return "";
}

std::string mapping_text(const Mapping& mapping) {
    std::string text;
    const auto add = [&](const char* name, const std::string& value) {
        if (!text.empty()) text += " ";
        text.append(name).append("=").append(value);
    };
    for (size_t i = 0; i < button_count; ++i)
        if (mapping.buttons[i] != 0) add(button_names[i], std::to_string(mapping.buttons[i]));
    for (size_t i = 0; i < axis_count; ++i)
        for (const NamedUsage& known : usage_names)
            if (mapping.axes[i].page != 0 && known.usage == mapping.axes[i])
                add(axis_names[i], known.name);
    return text;
}

} // namespace host::pads
