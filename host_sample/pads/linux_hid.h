// HID devices under Linux: found in sysfs, which costs microseconds and tells the real bus and the
// report descriptor, neither of which hidapi 0.13 does; opened by hidapi.
#pragma once

#include "hid.h"

namespace host::pads {

class LinuxHid : public HidSource {
public:
    // "devices" is where sysfs lists hidraw devices, "nodes" where their nodes are.
    explicit LinuxHid(std::string devices = "/sys/class/hidraw", std::string nodes = "/dev");
    ~LinuxHid() override;
    LinuxHid(const LinuxHid&) = delete;
    LinuxHid& operator=(const LinuxHid&) = delete;

    std::vector<std::string> names() override;
    bool describe(const std::string& name, HidNode& node) override;
    Opened open(const HidNode& node) override;

private:
    std::string devices_, nodes_;
};

} // namespace host::pads
