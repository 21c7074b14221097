#include "generic.h"

namespace host::pads {

namespace {

constexpr size_t packet_size = 64; // what a pad may fill its report up to

bool mapped_to_axis(const Mapping& mapping, Axis axis) {
    return mapping[axis].page != 0;
}

void set_axis(Axis axis, float value, float trigger, PadState& state) {
    switch (axis) {
    case Axis::left_x:
        state.left.x = value;
        break;
    case Axis::left_y:
        state.left.y = -value;
        break;
    case Axis::right_x:
        state.right.x = value;
        break;
    case Axis::right_y:
        state.right.y = -value;
        break;
    case Axis::left_trigger:
        state.left_trigger = trigger;
        break;
    case Axis::right_trigger:
        state.right_trigger = trigger;
        break;
    }
}

// A trigger that is only a button, or only an axis, is also the other.
void complete(Button button, float& trigger, bool has_axis, bool has_button, PadState& state) {
    if (has_axis && !has_button) state.buttons.set(button, trigger > 0.5f);
    if (has_button && !has_axis) trigger = state.buttons.has(button) ? 1.0f : 0.0f;
}

std::optional<Button> direction_of(Usage usage) {
    if (usage == usage::up) return Button::up;
    if (usage == usage::down) return Button::down;
    if (usage == usage::left) return Button::left;
    if (usage == usage::right) return Button::right;
    return std::nullopt;
}

} // namespace

bool is_gamepad(const ReportDescriptor& descriptor) {
    if (!descriptor.is(usage::gamepad) && !descriptor.is(usage::joystick)) return false;
    size_t buttons = 0;
    for (const InputField& field : descriptor.inputs)
        if (field.usage.page == usage::button) buttons += field.usages;
    const bool directions =
        descriptor.find(usage::hat) != nullptr
        || (descriptor.find(usage::x) != nullptr && descriptor.find(usage::y) != nullptr);
    return buttons >= 2 && directions;
}

GenericReader::GenericReader(const ReportDescriptor& descriptor, const Mapping& mapping)
    : mapping_(mapping), has_ids_(descriptor.has_ids), bits_(descriptor.input_bits) {
    for (const InputField& field : descriptor.inputs) add(field, mapping);
}

void GenericReader::add(const InputField& field, const Mapping& mapping) {
    using Kind = Control::Kind;
    if (field.usage.page == usage::button && field.array) {
        controls_.push_back({Kind::button_array, 0, field});
        return;
    }
    if (field.array) return;
    if (field.usage.page == usage::button) {
        for (size_t i = 0; i < button_count; ++i)
            if (mapping.buttons[i] == field.usage.id && field.usage.id != 0)
                controls_.push_back({Kind::button, static_cast<uint8_t>(i), field});
        return;
    }
    if (const auto direction = direction_of(field.usage)) {
        controls_.push_back({Kind::button, static_cast<uint8_t>(*direction), field});
        return;
    }
    if (field.usage == usage::hat && mapping.hat) {
        controls_.push_back({Kind::hat, 0, field});
        return;
    }
    for (size_t i = 0; i < axis_count; ++i)
        if (mapping.axes[i].page != 0 && mapping.axes[i] == field.usage)
            controls_.push_back({Kind::axis, static_cast<uint8_t>(i), field});
}

void GenericReader::read(const Control& control, Bytes payload, PadState& state) const {
    const InputField& field = control.field;
    const auto value = field.read(payload);
    switch (control.kind) {
    case Control::Kind::button:
        state.buttons.set(static_cast<Button>(control.target), value && *value != 0);
        break;
    case Control::Kind::button_array:
        if (!value || *value - field.lowest >= field.usages) break;
        for (size_t i = 0; i < button_count; ++i)
            if (mapping_.buttons[i] != 0
                && mapping_.buttons[i] == field.usage.id + (*value - field.lowest))
                state.buttons.set(static_cast<Button>(i));
        break;
    case Control::Kind::hat: {
        // Four positions are the straight ones of eight.
        const int64_t step = field.highest - field.lowest == 3 ? 2 : 1;
        state.buttons = state.buttons | hat_buttons(value ? (*value - field.lowest) * step : -1);
        break;
    }
    case Control::Kind::axis:
        if (value)
            set_axis(static_cast<Axis>(control.target),
                     centered(*value, field.lowest, field.highest),
                     from_zero(*value, field.lowest, field.highest), state);
        break;
    }
}

std::optional<PadState> GenericReader::parse(Bytes report, const PadState& before) const {
    if (report.empty()) return std::nullopt;
    const uint8_t id = has_ids_ ? report[0] : 0;
    const Bytes payload = has_ids_ ? report.subspan(1) : report;
    const size_t size = (bits_[id] + 7) / 8;
    if (size == 0 || payload.size() < size) return std::nullopt;
    if (payload.size() > size && report.size() > packet_size) return std::nullopt;

    using Kind = Control::Kind;
    PadState state = before;
    bool relevant = false;
    for (const Control& control : controls_) { // what an array or a hat does not name is up
        if (control.field.report != id) continue;
        relevant = true;
        if (control.kind == Kind::hat)
            for (const Button button : {Button::up, Button::down, Button::left, Button::right})
                state.buttons.set(button, false);
        if (control.kind == Kind::button_array)
            for (size_t i = 0; i < button_count; ++i)
                if (mapping_.buttons[i] != 0) state.buttons.set(static_cast<Button>(i), false);
    }
    if (!relevant) return std::nullopt;
    for (const Control& control : controls_)
        if (control.field.report == id) read(control, payload, state);
    complete(Button::left_trigger, state.left_trigger, mapped_to_axis(mapping_, Axis::left_trigger),
             mapping_[Button::left_trigger] != 0, state);
    complete(Button::right_trigger, state.right_trigger,
             mapped_to_axis(mapping_, Axis::right_trigger), mapping_[Button::right_trigger] != 0,
             state);
    return state;
}

} // namespace host::pads
