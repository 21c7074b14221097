// Microsoft's pads over Bluetooth. Layouts: the report descriptors that the pads send, as collected
// in docs/descriptors of the driver xpadneo.
#pragma once

#include <optional>
#include <vector>

#include "report.h"

namespace host::pads {

enum class XboxLayout {
    one_s_early, // 10 buttons in a row, guide in report 2
    one_s,       // 15 buttons with gaps, View after them, guide in report 2
    series       // 15 buttons with gaps, Share after them
};

// The product alone does not tell a One S with old firmware from one with new firmware: the number
// of buttons in the descriptor does.
XboxLayout xbox_layout(uint16_t product, size_t buttons_in_descriptor);

// Report 1 is the whole state but for the guide button of the One S, which comes in report 2 and
// is kept from "before".
std::optional<PadState> parse_xbox(Bytes report, XboxLayout layout, const PadState& before);

std::vector<uint8_t> xbox_output(Rumble rumble);

} // namespace host::pads
