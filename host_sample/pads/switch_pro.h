// Nintendo's Switch Pro Controller. Layouts: bluetooth_hid_notes.md, USB-HID-Notes.md and
// spi_flash_notes.md of github.com/dekuNukem/Nintendo_Switch_Reverse_Engineering, and the Linux
// driver drivers/hid/hid-nintendo.c.
#pragma once

#include <array>
#include <optional>

#include "report.h"

namespace host::pads {

// Counts of one axis: at rest and how far it goes either way.
struct SwitchAxis {
    uint16_t center = 2000, below = 1500, above = 1500;
    bool operator==(const SwitchAxis&) const = default;
};

struct SwitchSticks {
    SwitchAxis left_x, left_y, right_x, right_y;
    bool operator==(const SwitchSticks&) const = default;
};

// Where the calibration lies in the pad's flash memory, and how much to read.
constexpr uint32_t factory_sticks_at = 0x603d, user_sticks_at = 0x8010;
constexpr uint8_t factory_sticks_size = 18, user_sticks_size = 22;

// Each returns "sticks" with what the flash says; an erased or absurd stick keeps what it was.
SwitchSticks with_factory_sticks(SwitchSticks sticks, Bytes flash);
SwitchSticks with_user_sticks(SwitchSticks sticks, Bytes flash); // where the user calibrated

// Reports 0x30 (full), 0x21 (an answer to a command, with the state) and 0x3f (simple).
std::optional<PadState> parse_switch(Bytes report, const SwitchSticks& sticks);

} // namespace host::pads
