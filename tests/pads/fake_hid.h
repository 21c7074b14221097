// A machine whose pads are plugged in by the test.
#pragma once

#include <deque>
#include <map>

#include "descriptors.h"
#include "pads/hid.h"

namespace host::pads::test {

struct FakeDevice {
    HidNode node;
    std::deque<std::vector<uint8_t>> reports;
    std::vector<std::vector<uint8_t>> written;
    bool gone = false, denied = false;
    int opened = 0;
};

class FakePort : public HidPort {
public:
    explicit FakePort(std::shared_ptr<FakeDevice> device) : device_(std::move(device)) {}

    Read read(std::span<uint8_t> buffer, size_t& size) override {
        if (device_->gone) return Read::gone;
        if (device_->reports.empty()) return Read::none;
        const auto report = device_->reports.front();
        device_->reports.pop_front();
        size = std::min(report.size(), buffer.size());
        std::copy_n(report.begin(), size, buffer.begin());
        return Read::report;
    }
    bool write(Bytes report) override {
        device_->written.emplace_back(report.begin(), report.end());
        return !device_->gone;
    }
    std::vector<uint8_t> feature(uint8_t, size_t) override { return {}; }

private:
    std::shared_ptr<FakeDevice> device_;
};

class FakeHid : public HidSource {
public:
    std::shared_ptr<FakeDevice> plug_in(const std::string& name, Identity identity,
                                        const std::vector<uint8_t>& descriptor = {},
                                        const std::string& serial = "") {
        auto device = std::make_shared<FakeDevice>();
        device->node = {name, "/dev/" + name, identity, "Pad of " + name, serial, descriptor};
        devices_[name] = device;
        return device;
    }
    void pull_out(const std::string& name) {
        devices_.at(name)->gone = true;
        devices_.erase(name);
    }

    std::vector<std::string> names() override {
        ++scans;
        std::vector<std::string> names;
        for (const auto& [name, device] : devices_) names.push_back(name);
        return names;
    }
    bool describe(const std::string& name, HidNode& node) override {
        const auto found = devices_.find(name);
        if (found == devices_.end()) return false;
        node = found->second->node;
        return true;
    }
    Opened open(const HidNode& node) override {
        const auto device = devices_.at(node.name);
        if (device->denied) return {nullptr, true};
        ++device->opened;
        return {std::make_unique<FakePort>(device), false};
    }

    int scans = 0;

private:
    std::map<std::string, std::shared_ptr<FakeDevice>> devices_;
};

} // namespace host::pads::test
