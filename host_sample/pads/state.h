#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace host::pads {

// By place, not by label: south is Cross on a PlayStation pad, A on an Xbox pad, B on a Nintendo
// pad.
enum class Button : uint8_t {
    south,
    east,
    west,
    north,
    left_shoulder,
    right_shoulder,
    left_trigger,
    right_trigger,
    select,
    start,
    guide,
    left_stick,
    right_stick,
    up,
    down,
    left,
    right,
    touchpad,
    extra // Share on an Xbox Series pad, Capture on a Nintendo pad, the microphone of a DualSense
};
constexpr unsigned button_count = 19;

class Buttons {
public:
    constexpr Buttons() = default;

    constexpr bool has(Button button) const { return (bits_ & bit(button)) != 0; }
    constexpr bool any() const { return bits_ != 0; }
    constexpr void set(Button button, bool down = true) {
        bits_ = down ? bits_ | bit(button) : bits_ & ~bit(button);
    }
    constexpr Buttons operator|(Buttons other) const { return Buttons(bits_ | other.bits_); }
    constexpr Buttons without(Buttons other) const { return Buttons(bits_ & ~other.bits_); }
    constexpr bool operator==(const Buttons&) const = default;

private:
    constexpr explicit Buttons(uint32_t bits) : bits_(bits) {}
    static constexpr uint32_t bit(Button button) {
        return uint32_t{1} << static_cast<uint32_t>(button);
    }

    uint32_t bits_ = 0;
};

// Each in [-1, 1]; right and up are positive.
struct Stick {
    float x = 0.0f, y = 0.0f;
    bool operator==(const Stick&) const = default;
};

struct PadState {
    Buttons buttons;
    Stick left, right;
    float left_trigger = 0.0f, right_trigger = 0.0f; // [0, 1]
    // Radians a second about the axes right, up and towards the player.
    std::optional<std::array<float, 3>> gyro;

    bool operator==(const PadState&) const = default;
};

// The strong motor is the heavy, slow one.
struct Rumble {
    float strong = 0.0f, weak = 0.0f; // [0, 1]
    bool operator==(const Rumble&) const = default;
};

struct Color {
    uint8_t red = 0, green = 0, blue = 0;
    bool operator==(const Color&) const = default;
};

} // namespace host::pads
