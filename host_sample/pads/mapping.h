// Which controls of a pad that only its descriptor describes are which of ours.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "descriptor.h"

namespace host::pads {

enum class Axis : uint8_t { left_x, left_y, right_x, right_y, left_trigger, right_trigger };
constexpr unsigned axis_count = 6;

struct Mapping {
    std::array<uint16_t, button_count> buttons{}; // numbers, from 1; 0: none
    std::array<Usage, axis_count> axes{};         // page 0: none
    bool hat = false;                             // the directions come from a hat switch

    uint16_t& operator[](Button button) { return buttons[static_cast<size_t>(button)]; }
    uint16_t operator[](Button button) const { return buttons[static_cast<size_t>(button)]; }
    Usage& operator[](Axis axis) { return axes[static_cast<size_t>(axis)]; }
    Usage operator[](Axis axis) const { return axes[static_cast<size_t>(axis)]; }
    bool operator==(const Mapping&) const = default;
};

// In which order the makers number the buttons.
enum class ButtonOrder {
    guess,
    direct_input, // west south east north, shoulders, triggers, select start, sticks, guide
    xbox,         // south east west north, shoulders, select start, sticks, guide
    android,      // A B C X Y Z, shoulders, triggers, select start guide, sticks; A in the south
    nintendo      // the same with A in the east
};

// The greatest number of a button; 0: there are none.
uint16_t highest_button(const ReportDescriptor& descriptor);

Mapping default_mapping(const ReportDescriptor& descriptor, ButtonOrder order);

// "south=2 east=3 right_x=z left_trigger=brake": changes what is named. Returns a sentence about
// the first mistake, and then changes nothing; empty: none.
std::string apply_mapping_text(std::string_view text, Mapping& mapping);
std::string mapping_text(const Mapping& mapping);

} // namespace host::pads
