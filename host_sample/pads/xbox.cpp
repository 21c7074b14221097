#include "xbox.h"

namespace host::pads {

namespace {

constexpr size_t early_size = 16, late_size = 17;
constexpr size_t elite_size = 56; // the same and then paddles and profiles

Stick read_stick(Bytes report, size_t at) {
    return {centered(le16(report, at), 0, 65535), -centered(le16(report, at + 2), 0, 65535)};
}

Buttons early_buttons(Bytes report) {
    using enum Button;
    static constexpr Button low[] = {south,         east,           west,   north,
                                     left_shoulder, right_shoulder, select, start};
    static constexpr Button high[] = {left_stick, right_stick};
    return byte_buttons(report[14], low) | byte_buttons(report[15], high);
}

Buttons late_buttons(Bytes report, XboxLayout layout) {
    using enum Button;
    struct Place {
        size_t at;
        uint8_t mask;
        Button button;
    };
    static constexpr Place places[] = {
        {14, 0x01, south},      {14, 0x02, east},          {14, 0x08, west},
        {14, 0x10, north},      {14, 0x40, left_shoulder}, {14, 0x80, right_shoulder},
        {15, 0x04, select},     {15, 0x08, start},         {15, 0x10, guide},
        {15, 0x20, left_stick}, {15, 0x40, right_stick},
    };
    Buttons buttons;
    for (const Place& place : places)
        if ((report[place.at] & place.mask) != 0) buttons.set(place.button);
    if ((report[16] & 0x01) != 0) buttons.set(layout == XboxLayout::series ? extra : select);
    return buttons;
}

} // namespace

XboxLayout xbox_layout(uint16_t product, size_t buttons_in_descriptor) {
    if (buttons_in_descriptor <= 10 && buttons_in_descriptor > 0) return XboxLayout::one_s_early;
    switch (product) {
    case 0x02e0:
        return XboxLayout::one_s_early;
    case 0x02fd:
    case 0x0b05:
    case 0x0b0c:
        return XboxLayout::one_s;
    default:
        return XboxLayout::series;
    }
}

std::optional<PadState> parse_xbox(Bytes report, XboxLayout layout, const PadState& before) {
    if (report.size() == 2 && report[0] == 0x02 && layout != XboxLayout::series) {
        PadState state = before;
        state.buttons.set(Button::guide, (report[1] & 0x01) != 0);
        return state;
    }
    const bool early = layout == XboxLayout::one_s_early;
    const size_t size = early ? early_size : late_size;
    if (report.size() != size && (early || report.size() < size || report.size() > elite_size))
        return std::nullopt;
    if (report[0] != 0x01) return std::nullopt;
    PadState state;
    state.left = read_stick(report, 1);
    state.right = read_stick(report, 5);
    state.left_trigger = from_zero(le16(report, 9) & 0x03ff, 0, 1023);
    state.right_trigger = from_zero(le16(report, 11) & 0x03ff, 0, 1023);
    state.buttons = hat_buttons((report[13] & 0x0f) - 1)
                    | (early ? early_buttons(report) : late_buttons(report, layout));
    if (layout != XboxLayout::series && before.buttons.has(Button::guide))
        state.buttons.set(Button::guide);
    state.buttons.set(Button::left_trigger, state.left_trigger > 0.5f);
    state.buttons.set(Button::right_trigger, state.right_trigger > 0.5f);
    return state;
}

std::vector<uint8_t> xbox_output(Rumble rumble) {
    // Which motors; triggers, handles (in per cent); then for how long, in 10 ms, after what delay
    // and how many times more: ten minutes, which the next report ends.
    return {0x03, 0x03, 0,   0, to_byte(rumble.strong, 100), to_byte(rumble.weak, 100),
            0xff, 0x00, 0xeb};
}

} // namespace host::pads
