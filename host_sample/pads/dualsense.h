// Sony's pad of 2020 and its Edge. Layouts: the Linux driver drivers/hid/hid-playstation.c.
#pragma once

#include <optional>
#include <vector>

#include "sony.h"

namespace host::pads {

// Any input report of the pad, USB or Bluetooth; nothing if it is damaged or carries no state.
std::optional<PadState> parse_dualsense(Bytes report, const GyroScale& gyro);

struct DualSenseEffects {
    Rumble rumble;
    Color light;
    bool new_vibration = false;  // the firmware speaks the second version of the vibration flags
    bool end_light_show = false; // after pairing over Bluetooth the pad keeps the light to itself
};

// Whether the firmware report 0x20 tells of the second version of the vibration flags.
bool has_new_vibration(Bytes firmware);

std::vector<uint8_t> dualsense_usb_output(const DualSenseEffects& effects);
// Consecutive reports have consecutive numbers; the lower four bits are sent.
std::vector<uint8_t> dualsense_bluetooth_output(const DualSenseEffects& effects, unsigned number);

} // namespace host::pads
