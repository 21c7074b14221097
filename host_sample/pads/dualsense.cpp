#include "dualsense.h"

namespace host::pads {

namespace {

constexpr size_t usb_size = 64, bluetooth_size = 78;

PadState read_full(Bytes body, const GyroScale& gyro) {
    PadState state;
    read_sony_sticks(body, 0, state);
    state.left_trigger = from_zero(body[4], 0, 255);
    state.right_trigger = from_zero(body[5], 0, 255);
    state.buttons = sony_buttons(body[7], body[8], body[9]);
    state.buttons.set(Button::extra, (body[9] & 0x04) != 0);
    state.gyro = gyro.rates(body, 15);
    return state;
}

// 47 bytes from the flags on.
void write_effects(std::vector<uint8_t>& report, size_t at, const DualSenseEffects& effects) {
    const uint8_t compatible = 0x01, haptics = 0x02; // flags 0
    const uint8_t lightbar = 0x04;                   // flags 1
    const uint8_t setup = 0x02, compatible2 = 0x04;  // flags 2
    report[at] = effects.new_vibration ? haptics : haptics | compatible;
    report[at + 1] = lightbar;
    report[at + 2] = to_byte(effects.rumble.weak);
    report[at + 3] = to_byte(effects.rumble.strong);
    if (effects.new_vibration) report[at + 38] |= compatible2;
    if (effects.end_light_show) {
        report[at + 38] |= setup;
        report[at + 41] = 0x02; // fade out
    }
    report[at + 44] = effects.light.red;
    report[at + 45] = effects.light.green;
    report[at + 46] = effects.light.blue;
}

} // namespace

std::optional<PadState> parse_dualsense(Bytes report, const GyroScale& gyro) {
    if (report.empty()) return std::nullopt;
    if (report[0] == 0x01 && report.size() == usb_size) return read_full(report.subspan(1), gyro);
    if (report[0] == 0x31 && report.size() == bluetooth_size && sony_signature_holds(report))
        return read_full(report.subspan(2), gyro);
    return parse_sony_simple(report);
}

bool has_new_vibration(Bytes firmware) {
    return firmware.size() >= 46 && le16(firmware, 44) >= 0x0215;
}

std::vector<uint8_t> dualsense_usb_output(const DualSenseEffects& effects) {
    std::vector<uint8_t> report(63);
    report[0] = 0x02;
    write_effects(report, 1, effects);
    return report;
}

std::vector<uint8_t> dualsense_bluetooth_output(const DualSenseEffects& effects, unsigned number) {
    std::vector<uint8_t> report(bluetooth_size);
    report[0] = 0x31;
    report[1] = static_cast<uint8_t>((number & 0x0f) << 4);
    report[2] = 0x10; // an HID report follows
    write_effects(report, 3, effects);
    sign_sony_report(report);
    return report;
}

} // namespace host::pads
