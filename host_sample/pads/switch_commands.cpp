#include "switch_commands.h"

#include <cmath>

namespace host::pads {

namespace {

constexpr size_t command_size = 49; // what both USB and Bluetooth take

// Amplitudes are logarithmic; 100 steps, of which the last is the strongest that does not harm the
// actuators (switch_pro.h's notes, "rumble data").
uint8_t amplitude_step(float amplitude) {
    const float a = std::clamp(amplitude, 0.0f, 1.0f);
    if (a <= 0.0f) return 0;
    const float step = a > 0.23f   ? std::log2(a * 8.7f) * 32.0f
                       : a > 0.12f ? std::log2(a * 17.0f) * 16.0f
                                   : a / 0.12f * 16.0f;
    return static_cast<uint8_t>(std::clamp(step + 0.5f, 1.0f, 100.0f));
}

// 320 Hz for the weak motor and 160 Hz for the strong one.
std::array<uint8_t, 4> vibration(Rumble rumble) {
    const uint8_t high = amplitude_step(rumble.weak), low = amplitude_step(rumble.strong);
    return {0x00, static_cast<uint8_t>(0x01 + 2 * high),
            static_cast<uint8_t>(0x40 | (low & 1) << 7), static_cast<uint8_t>(0x40 + low / 2)};
}

void put_vibration(std::vector<uint8_t>& report, Rumble rumble) {
    const auto one = vibration(rumble);
    for (size_t i = 0; i < 8; ++i) report[2 + i] = one[i % 4];
}

} // namespace

std::vector<uint8_t> switch_usb_command(SwitchUsb command) {
    std::vector<uint8_t> report(64);
    report[0] = 0x80;
    report[1] = static_cast<uint8_t>(command);
    return report;
}

std::vector<uint8_t> switch_command(SwitchCommand command, Bytes arguments, unsigned number) {
    std::vector<uint8_t> report(command_size);
    report[0] = 0x01;
    report[1] = number & 0x0f;
    put_vibration(report, {});
    report[10] = static_cast<uint8_t>(command);
    for (size_t i = 0; i < arguments.size() && 11 + i < report.size(); ++i)
        report[11 + i] = arguments[i];
    return report;
}

std::vector<uint8_t> switch_rumble(Rumble rumble, unsigned number) {
    std::vector<uint8_t> report(10);
    report[0] = 0x10;
    report[1] = number & 0x0f;
    put_vibration(report, rumble);
    return report;
}

std::vector<uint8_t> flash_arguments(uint32_t address, uint8_t size) {
    return {static_cast<uint8_t>(address), static_cast<uint8_t>(address >> 8),
            static_cast<uint8_t>(address >> 16), static_cast<uint8_t>(address >> 24), size};
}

std::optional<SwitchUsb> confirmed_usb_command(Bytes report) {
    if (report.size() < 2 || report[0] != 0x81) return std::nullopt;
    return static_cast<SwitchUsb>(report[1]);
}

std::optional<SwitchAnswer> command_answer(Bytes report) {
    if (report.size() < 49 || report.size() > 64 || report[0] != 0x21) return std::nullopt;
    if ((report[13] & 0x80) == 0) return std::nullopt; // refused
    return SwitchAnswer{static_cast<SwitchCommand>(report[14]), report.subspan(15)};
}

std::optional<Bytes> flash_content(const SwitchAnswer& answer, uint32_t address, uint8_t size) {
    if (answer.command != SwitchCommand::read_flash || answer.data.size() < 5u + size)
        return std::nullopt;
    if (le32(answer.data, 0) != address || answer.data[4] != size) return std::nullopt;
    return answer.data.subspan(5, size);
}

} // namespace host::pads
