// A HID device that this program is: the kernel sees a new device and hands its reports to whoever
// opens its node. Needs /dev/uhid and the rights to it.
#pragma once

#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "pads/model.h"

namespace host::pads::test {

struct UhidDescription {
    std::string name, serial;
    Identity identity;
    std::vector<uint8_t> descriptor;
    std::map<uint8_t, std::vector<uint8_t>> features; // what it answers, id first
};

class UhidPad {
public:
    explicit UhidPad(const UhidDescription& description); // plugs it in; throws if it cannot
    ~UhidPad();                                           // pulls it out
    UhidPad(const UhidPad&) = delete;
    UhidPad& operator=(const UhidPad&) = delete;

    void input(const std::vector<uint8_t>& report);
    std::vector<std::vector<uint8_t>> outputs() const; // that arrived until now

private:
    void serve();
    void answer(uint32_t id, uint8_t report);

    std::map<uint8_t, std::vector<uint8_t>> features_;
    int file_;
    std::atomic<bool> stop_ = false;
    mutable std::mutex mutex_;
    std::vector<std::vector<uint8_t>> outputs_;
    std::thread thread_;
};

} // namespace host::pads::test
