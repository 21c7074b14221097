#pragma once

#include <cstdint>

#include "report.h"

namespace host::pads {

// CRC-32 (IEEE 802.3) of a byte and then of the others. Sony's pads sign Bluetooth reports with it;
// the first byte is the header of the Bluetooth HID transaction, which is not part of the report.
uint32_t crc32(uint8_t first, Bytes rest);

constexpr uint8_t bluetooth_input = 0xa1, bluetooth_output = 0xa2;

} // namespace host::pads
