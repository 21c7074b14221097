// 8BitDo's pads. Which mode is on decides what they pretend to be:
//   Start + B (D-input, Android)   vendor 2dc8: this file
//   Start + X (X-input), Bluetooth a Xbox One S with old firmware: xbox.h
//   Start + A (macOS)              a DualShock 4: dualshock4.h
//   Start + Y (Switch)             a Switch Pro Controller: switch_pro.h
//   X-input over USB is not HID; the kernel's xpad reads it.
// Documents: the manuals of the SN30 Pro and the Pro 2; identities and the motors' report as in
// SDL's hidapi driver for 8BitDo.
#pragma once

#include <vector>

#include "mapping.h"

namespace host::pads {

// Most of their pads print the letters as Nintendo does (A in the east); the later Ultimates as
// Microsoft does.
bool eightbitdo_has_xbox_letters(uint16_t product);

Mapping eightbitdo_mapping(const ReportDescriptor& descriptor, uint16_t product);

// Only firmware whose descriptor declares this report has it.
constexpr uint8_t eightbitdo_output_id = 0x05;
std::vector<uint8_t> eightbitdo_output(Rumble rumble);

} // namespace host::pads
