#include "dualshock4.h"

namespace host::pads {

namespace {

constexpr size_t usb_size = 64, bluetooth_size = 78;

PadState read_full(Bytes body, const GyroScale& gyro) {
    PadState state;
    read_sony_sticks(body, 0, state);
    state.buttons = sony_buttons(body[4], body[5], body[6]);
    state.left_trigger = from_zero(body[7], 0, 255);
    state.right_trigger = from_zero(body[8], 0, 255);
    state.gyro = gyro.rates(body, 12);
    return state;
}

// Ten bytes from the flags on: motors and light.
void write_effects(std::vector<uint8_t>& report, size_t at, Rumble rumble, Color light) {
    report[at] = 0x01 | 0x02; // motors and light are valid
    report[at + 3] = to_byte(rumble.weak);
    report[at + 4] = to_byte(rumble.strong);
    report[at + 5] = light.red;
    report[at + 6] = light.green;
    report[at + 7] = light.blue;
}

} // namespace

std::optional<PadState> parse_dualshock4(Bytes report, const GyroScale& gyro) {
    if (report.empty()) return std::nullopt;
    if (report[0] == 0x01 && report.size() == usb_size) return read_full(report.subspan(1), gyro);
    if (report[0] == 0x11 && report.size() == bluetooth_size && sony_signature_holds(report))
        return read_full(report.subspan(3), gyro);
    return parse_sony_simple(report);
}

std::vector<uint8_t> dualshock4_usb_output(Rumble rumble, Color light) {
    std::vector<uint8_t> report(32);
    report[0] = 0x05;
    write_effects(report, 1, rumble, light);
    return report;
}

std::vector<uint8_t> dualshock4_bluetooth_output(Rumble rumble, Color light) {
    std::vector<uint8_t> report(bluetooth_size);
    report[0] = 0x11;
    report[1] = 0x80 | 0x40 | 0x04; // HID data, signed, and an input report every 4 ms
    write_effects(report, 3, rumble, light);
    sign_sony_report(report);
    return report;
}

} // namespace host::pads
