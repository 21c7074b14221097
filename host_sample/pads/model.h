// Which pad a HID device is.
#pragma once

#include <cstdint>
#include <string>

#include "mapping.h"

namespace host::pads {

enum class Bus : uint8_t { usb, bluetooth, other };
enum class Family : uint8_t { dualshock4, dualsense, switch_pro, xbox, eightbitdo, generic };

struct Identity {
    uint16_t vendor = 0, product = 0;
    Bus bus = Bus::other;
};

Family family_of(const Identity& identity);
const char* family_name(Family family);
const char* bus_name(Bus bus);

} // namespace host::pads
