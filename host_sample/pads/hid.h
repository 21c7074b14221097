// The HID devices of this machine. Abstract, so that tests can plug pads in.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "driver.h"

namespace host::pads {

struct HidNode {
    std::string name; // hidraw0
    std::string path; // /dev/hidraw0
    Identity identity;
    std::string product;             // what the device calls itself
    std::string serial;              // of a Bluetooth device its address
    std::vector<uint8_t> descriptor; // of its reports
};

// An open device.
class HidPort : public Link {
public:
    enum class Read { none, report, gone };
    // Never waits. The report is in the front of the buffer.
    virtual Read read(std::span<uint8_t> buffer, size_t& size) = 0;
};

struct Opened {
    std::unique_ptr<HidPort> port; // none: it could not be opened
    bool denied = false;           // for lack of permission
};

class HidSource {
public:
    virtual ~HidSource() = default;
    // Cheap enough to be asked every second. In ascending order.
    virtual std::vector<std::string> names() = 0;
    // False if it went away meanwhile.
    virtual bool describe(const std::string& name, HidNode& node) = 0;
    virtual Opened open(const HidNode& node) = 0;
};

// A sentence for the player whose pad may not be opened.
std::string permission_advice(const HidNode& node);

} // namespace host::pads
