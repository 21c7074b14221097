// Sony's pad of 2013. Layouts: the Linux driver drivers/hid/hid-playstation.c.
#pragma once

#include <optional>
#include <vector>

#include "sony.h"

namespace host::pads {

// Any input report of the pad, USB or Bluetooth; nothing if it is damaged or carries no state.
std::optional<PadState> parse_dualshock4(Bytes report, const GyroScale& gyro);

std::vector<uint8_t> dualshock4_usb_output(Rumble rumble, Color light);
std::vector<uint8_t> dualshock4_bluetooth_output(Rumble rumble, Color light);

} // namespace host::pads
