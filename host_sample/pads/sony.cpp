#include "sony.h"

#include <cmath>

#include "crc32.h"

namespace host::pads {

namespace {

constexpr float degree = 0.017453293f;

} // namespace

GyroScale::GyroScale() {
    scale.fill(2000.0f / 32768.0f * degree);
}

std::array<float, 3> GyroScale::rates(Bytes report, size_t at) const {
    std::array<float, 3> rates;
    for (size_t axis = 0; axis < 3; ++axis)
        rates[axis] = (signed_le16(report, at + 2 * axis) - bias[axis]) * scale[axis];
    return rates;
}

std::optional<GyroScale> parse_sony_calibration(Bytes feature, GyroOrder order) {
    if (feature.size() < 23) return std::nullopt;
    const float speed = static_cast<float>(signed_le16(feature, 19) + signed_le16(feature, 21));
    GyroScale result;
    for (size_t axis = 0; axis < 3; ++axis) {
        const bool by_axis = order == GyroOrder::by_axis;
        const size_t plus_at = 7 + axis * (by_axis ? 4 : 2), minus_at = plus_at + (by_axis ? 2 : 6);
        const float bias = signed_le16(feature, 1 + 2 * axis);
        const float counts = std::abs(signed_le16(feature, plus_at) - bias)
                             + std::abs(signed_le16(feature, minus_at) - bias);
        if (!(speed > 0.0f) || !(counts > 0.0f)) return std::nullopt;
        result.bias[axis] = bias;
        result.scale[axis] = speed / counts * degree;
    }
    return result;
}

Buttons sony_buttons(uint8_t first, uint8_t second, uint8_t third) {
    using enum Button;
    static constexpr Button faces[] = {west, south, east, north};
    static constexpr Button others[] = {left_shoulder, right_shoulder, left_trigger, right_trigger,
                                        select,        start,          left_stick,   right_stick};
    static constexpr Button middle[] = {guide, touchpad};
    return hat_buttons(first & 0x0f) | byte_buttons(static_cast<uint8_t>(first >> 4), faces)
           | byte_buttons(second, others) | byte_buttons(third, middle);
}

void read_sony_sticks(Bytes report, size_t at, PadState& state) {
    state.left = {centered(report[at], 0, 255), -centered(report[at + 1], 0, 255)};
    state.right = {centered(report[at + 2], 0, 255), -centered(report[at + 3], 0, 255)};
}

std::optional<PadState> parse_sony_simple(Bytes report) {
    if (report.size() != 10 || report[0] != 0x01) return std::nullopt;
    PadState state;
    read_sony_sticks(report, 1, state);
    // The upper bits of the third byte count reports.
    state.buttons = sony_buttons(report[5], report[6], report[7]);
    state.left_trigger = from_zero(report[8], 0, 255);
    state.right_trigger = from_zero(report[9], 0, 255);
    return state;
}

bool sony_signature_holds(Bytes report) {
    if (report.size() < 5) return false;
    const size_t end = report.size() - 4;
    return crc32(bluetooth_input, report.first(end)) == le32(report, end);
}

void sign_sony_report(std::vector<uint8_t>& report) {
    const size_t end = report.size() - 4;
    const uint32_t crc = crc32(bluetooth_output, Bytes(report).first(end));
    for (size_t i = 0; i < 4; ++i) report[end + i] = static_cast<uint8_t>(crc >> 8 * i);
}

} // namespace host::pads
