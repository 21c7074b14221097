// HID report descriptors. Documents: "Device Class Definition for HID 1.11", sections 5 and 6.2.2,
// and "HID Usage Tables".
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <vector>

#include "report.h"

namespace host::pads {

struct Usage {
    uint16_t page = 0, id = 0;
    bool operator==(const Usage&) const = default;
};

namespace usage {
constexpr uint16_t desktop = 0x01, simulation = 0x02, button = 0x09, consumer = 0x0c;
constexpr Usage joystick{desktop, 0x04}, gamepad{desktop, 0x05};
constexpr Usage x{desktop, 0x30}, y{desktop, 0x31}, z{desktop, 0x32};
constexpr Usage rx{desktop, 0x33}, ry{desktop, 0x34}, rz{desktop, 0x35};
constexpr Usage hat{desktop, 0x39};
constexpr Usage up{desktop, 0x90}, down{desktop, 0x91}, right{desktop, 0x92}, left{desktop, 0x93};
constexpr Usage accelerator{simulation, 0xc4}, brake{simulation, 0xc5};
} // namespace usage

// A number in input reports. Of an array, whose values are indices of usages, each element is a
// field that has several usages.
struct InputField {
    uint8_t report = 0; // id; 0 where the descriptor has no ids
    uint32_t bit = 0;   // from the first byte after the id
    uint8_t bits = 0;   // 1 to 32
    bool array = false;
    int64_t lowest = 0, highest = 0; // logical
    Usage usage{};                   // of an array, what "lowest" stands for
    uint16_t usages = 1;             // of an array: consecutive ones

    // The number in the payload of a report that has the field's id; the payload must be long
    // enough. Nothing if it is outside of lowest..highest ("null").
    std::optional<int64_t> read(Bytes payload) const;
};

struct ReportDescriptor {
    std::vector<Usage> applications; // what the device says that it is
    std::vector<InputField> inputs;  // constant and relative ones are left out
    bool has_ids = false;
    std::array<uint32_t, 256> input_bits{}; // size of each input report, without the id
    std::bitset<256> output_ids;

    bool is(Usage application) const;
    const InputField* find(Usage usage) const; // the first
};

// Nothing if it is damaged or beyond every sane size.
std::optional<ReportDescriptor> parse_descriptor(Bytes bytes);

} // namespace host::pads
