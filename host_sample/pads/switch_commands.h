// What is sent to a Switch Pro Controller and what it answers. Documents: see switch_pro.h, and
// rumble_data_table.md of the same place.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "report.h"

namespace host::pads {

enum class SwitchUsb : uint8_t { handshake = 0x02, baud_rate = 0x03, no_timeout = 0x04 };

enum class SwitchCommand : uint8_t {
    set_report_mode = 0x03,
    read_flash = 0x10,
    set_player_lights = 0x30,
    enable_gyro = 0x40,
    enable_vibration = 0x48
};

std::vector<uint8_t> switch_usb_command(SwitchUsb command);

// Consecutive reports have consecutive numbers; the lower four bits are sent.
std::vector<uint8_t> switch_command(SwitchCommand command, Bytes arguments, unsigned number);
std::vector<uint8_t> switch_rumble(Rumble rumble, unsigned number);

std::vector<uint8_t> flash_arguments(uint32_t address, uint8_t size);

// The USB command that a report confirms, or the command that it answers, with the data.
std::optional<SwitchUsb> confirmed_usb_command(Bytes report);
struct SwitchAnswer {
    SwitchCommand command;
    Bytes data; // within the report
};
std::optional<SwitchAnswer> command_answer(Bytes report);

// The bytes that were asked for, if it is the answer to that question.
std::optional<Bytes> flash_content(const SwitchAnswer& answer, uint32_t address, uint8_t size);

} // namespace host::pads
