// Any pad, read as its report descriptor says.
#pragma once

#include <optional>
#include <vector>

#include "mapping.h"

namespace host::pads {

// Whether the device calls itself a gamepad or joystick and has what a game needs.
bool is_gamepad(const ReportDescriptor& descriptor);

class GenericReader {
public:
    GenericReader(const ReportDescriptor& descriptor, const Mapping& mapping);

    // A report need not carry every control: the others stay as they were before.
    std::optional<PadState> parse(Bytes report, const PadState& before) const;

private:
    struct Control {
        enum class Kind : uint8_t { button, button_array, hat, axis } kind;
        uint8_t target; // Button or Axis
        InputField field;
    };

    void add(const InputField& field, const Mapping& mapping);
    void read(const Control& control, Bytes payload, PadState& state) const;

    std::vector<Control> controls_;
    Mapping mapping_;
    bool has_ids_;
    std::array<uint32_t, 256> bits_;
};

} // namespace host::pads
