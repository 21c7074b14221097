#include "switch_pro.h"

namespace host::pads {

namespace {

constexpr uint8_t simple = 0x3f, full = 0x30, answer = 0x21;
constexpr size_t simple_size = 12, full_size = 49, packet_size = 64; // USB pads to the packet
constexpr float gyro_scale = 0.070f * 0.017453293f; // 70 millidegrees a second and count

struct Pair {
    uint16_t first, second;
};

Pair twelve_bits(Bytes bytes, size_t at) {
    return {static_cast<uint16_t>(bytes[at] | (bytes[at + 1] & 0x0f) << 8),
            static_cast<uint16_t>(bytes[at + 1] >> 4 | bytes[at + 2] << 4)};
}

bool credible(const SwitchAxis& axis) {
    const auto reach_is_sane = [](uint16_t reach) { return reach >= 256 && reach <= 2600; };
    return reach_is_sane(axis.below) && reach_is_sane(axis.above) && axis.center >= axis.below
           && axis.center + axis.above <= 4095;
}

void assign(SwitchAxis& x, SwitchAxis& y, Pair above, Pair center, Pair below) {
    const SwitchAxis new_x{center.first, below.first, above.first};
    const SwitchAxis new_y{center.second, below.second, above.second};
    if (!credible(new_x) || !credible(new_y)) return;
    x = new_x;
    y = new_y;
}

void assign_left(SwitchSticks& sticks, Bytes flash, size_t at) {
    assign(sticks.left_x, sticks.left_y, twelve_bits(flash, at), twelve_bits(flash, at + 3),
           twelve_bits(flash, at + 6));
}

void assign_right(SwitchSticks& sticks, Bytes flash, size_t at) {
    assign(sticks.right_x, sticks.right_y, twelve_bits(flash, at + 6), twelve_bits(flash, at),
           twelve_bits(flash, at + 3));
}

float calibrated(uint16_t count, const SwitchAxis& axis) {
    const float away = static_cast<float>(count) - static_cast<float>(axis.center);
    return std::clamp(away / static_cast<float>(away < 0.0f ? axis.below : axis.above), -1.0f,
                      1.0f);
}

// There are only two positions.
void set_triggers(PadState& state) {
    state.left_trigger = state.buttons.has(Button::left_trigger) ? 1.0f : 0.0f;
    state.right_trigger = state.buttons.has(Button::right_trigger) ? 1.0f : 0.0f;
}

// The mean of three samples. The sensor's axes point forwards, to the left and upwards.
std::array<float, 3> read_gyro(Bytes report) {
    std::array<float, 3> rates{};
    for (size_t sample = 0; sample < 3; ++sample) {
        const size_t at = 13 + 12 * sample + 6;
        rates[0] -= signed_le16(report, at + 2);
        rates[1] += signed_le16(report, at + 4);
        rates[2] -= signed_le16(report, at);
    }
    for (float& rate : rates) rate *= gyro_scale / 3.0f;
    return rates;
}

PadState read_full(Bytes report, const SwitchSticks& sticks) {
    using enum Button;
    struct Place {
        size_t at;
        uint8_t mask;
        Button button;
    };
    static constexpr Place places[] = {
        {3, 0x01, west},           {3, 0x02, north},
        {3, 0x04, south},          {3, 0x08, east},
        {3, 0x40, right_shoulder}, {3, 0x80, right_trigger},
        {4, 0x01, select},         {4, 0x02, start},
        {4, 0x04, right_stick},    {4, 0x08, left_stick},
        {4, 0x10, guide},          {4, 0x20, extra},
        {5, 0x01, down},           {5, 0x02, up},
        {5, 0x04, right},          {5, 0x08, left},
        {5, 0x40, left_shoulder},  {5, 0x80, left_trigger},
    };
    PadState state;
    for (const Place& place : places)
        if ((report[place.at] & place.mask) != 0) state.buttons.set(place.button);
    set_triggers(state);
    const Pair one = twelve_bits(report, 6), two = twelve_bits(report, 9);
    state.left = {calibrated(one.first, sticks.left_x), calibrated(one.second, sticks.left_y)};
    state.right = {calibrated(two.first, sticks.right_x), calibrated(two.second, sticks.right_y)};
    if (report[0] == full) state.gyro = read_gyro(report);
    return state;
}

PadState read_simple(Bytes report) {
    using enum Button;
    static constexpr Button first[] = {south,         east,           west,         north,
                                       left_shoulder, right_shoulder, left_trigger, right_trigger};
    static constexpr Button second[] = {select, start, left_stick, right_stick, guide, extra};
    PadState state;
    state.buttons = byte_buttons(report[1], first) | byte_buttons(report[2], second)
                    | hat_buttons(report[3] & 0x0f);
    set_triggers(state);
    const auto axis = [&](size_t at) { return centered(le16(report, at), 0, 65535); };
    state.left = {axis(4), -axis(6)};
    state.right = {axis(8), -axis(10)};
    return state;
}

} // namespace

SwitchSticks with_factory_sticks(SwitchSticks sticks, Bytes flash) {
    if (flash.size() < factory_sticks_size) return sticks;
    assign_left(sticks, flash, 0);
    assign_right(sticks, flash, 9);
    return sticks;
}

SwitchSticks with_user_sticks(SwitchSticks sticks, Bytes flash) {
    if (flash.size() < user_sticks_size) return sticks;
    const auto marked = [&](size_t at) { return flash[at] == 0xb2 && flash[at + 1] == 0xa1; };
    if (marked(0)) assign_left(sticks, flash, 2);
    if (marked(11)) assign_right(sticks, flash, 13);
    return sticks;
}

std::optional<PadState> parse_switch(Bytes report, const SwitchSticks& sticks) {
    if (report.empty() || report.size() > packet_size) return std::nullopt;
    if (report[0] == simple && report.size() >= simple_size) return read_simple(report);
    if ((report[0] == full || report[0] == answer) && report.size() >= full_size)
        return read_full(report, sticks);
    return std::nullopt;
}

} // namespace host::pads
