// What all readers of reports share.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "state.h"

namespace host::pads {

using Bytes = std::span<const uint8_t>;

inline uint16_t le16(Bytes bytes, size_t at) {
    return static_cast<uint16_t>(bytes[at] | bytes[at + 1] << 8);
}

inline int16_t signed_le16(Bytes bytes, size_t at) {
    return static_cast<int16_t>(le16(bytes, at));
}

inline uint32_t le32(Bytes bytes, size_t at) {
    return le16(bytes, at) | static_cast<uint32_t>(le16(bytes, at + 2)) << 16;
}

// From lowest..highest to [-1, 1]. The middle of an even number of values is the upper of the two
// (128 of 0..255), as the pads' makers have it.
inline float centered(int64_t value, int64_t lowest, int64_t highest) {
    const int64_t middle = lowest + (highest - lowest + 1) / 2;
    const int64_t reach = value < middle ? middle - lowest : highest - middle;
    if (reach <= 0) return 0.0f;
    return std::clamp(
        static_cast<float>(static_cast<double>(value - middle) / static_cast<double>(reach)), -1.0f,
        1.0f);
}

// From lowest..highest to [0, 1].
inline float from_zero(int64_t value, int64_t lowest, int64_t highest) {
    if (highest <= lowest) return 0.0f;
    return std::clamp(static_cast<float>(static_cast<double>(value - lowest)
                                         / static_cast<double>(highest - lowest)),
                      0.0f, 1.0f);
}

// Directions count clockwise from north, as the HID usage tables say; anything else is "at rest".
inline Buttons hat_buttons(int64_t direction) {
    Buttons buttons;
    if (direction < 0 || direction > 7) return buttons;
    buttons.set(Button::up, direction == 7 || direction <= 1);
    buttons.set(Button::right, direction >= 1 && direction <= 3);
    buttons.set(Button::down, direction >= 3 && direction <= 5);
    buttons.set(Button::left, direction >= 5);
    return buttons;
}

// A byte in which bit i says whether order[i] is down.
template <size_t N>
Buttons byte_buttons(uint8_t byte, const Button (&order)[N]) {
    static_assert(N <= 8);
    Buttons buttons;
    for (size_t i = 0; i < N; ++i) buttons.set(order[i], (byte >> i & 1) != 0);
    return buttons;
}

inline uint8_t to_byte(float part, float full = 255.0f) {
    return static_cast<uint8_t>(std::clamp(part, 0.0f, 1.0f) * full + 0.5f);
}

} // namespace host::pads
