// What the DualShock 4 and the DualSense have in common. Layouts: the Linux driver
// drivers/hid/hid-playstation.c, by Sony.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "report.h"

namespace host::pads {

// Turns the gyroscope's counts into radians a second, one entry an axis.
struct GyroScale {
    std::array<float, 3> bias{};
    std::array<float, 3> scale;

    GyroScale(); // nominal: the full 16 bits are 2000 degrees a second

    std::array<float, 3> rates(Bytes report, size_t at) const;
};

// How the feature report arranges the three axes' counts at full speed: x+ x- y+ y- z+ z-, or, the
// DualShock 4 over Bluetooth, x+ y+ z+ x- y- z-.
enum class GyroOrder { by_axis, by_sign };

// Nothing if the report is too short or makes no sense.
std::optional<GyroScale> parse_sony_calibration(Bytes feature, GyroOrder order);

// Hat, face buttons, shoulders, stick buttons, PS and touchpad: three bytes.
Buttons sony_buttons(uint8_t first, uint8_t second, uint8_t third);

// The short report 0x01 that both pads send over Bluetooth until their full mode is switched on.
std::optional<PadState> parse_sony_simple(Bytes report);

// The left and the right stick from four bytes.
void read_sony_sticks(Bytes report, size_t at, PadState& state);

// Whether the last four bytes sign the others.
bool sony_signature_holds(Bytes report);
void sign_sony_report(std::vector<uint8_t>& report);

} // namespace host::pads
