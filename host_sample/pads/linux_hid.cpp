#include "linux_hid.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <hidapi/hidapi.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace host::pads {

namespace {

class HidapiPort : public HidPort {
public:
    explicit HidapiPort(hid_device* device) : device_(device) {}
    ~HidapiPort() override { hid_close(device_); }
    HidapiPort(const HidapiPort&) = delete;
    HidapiPort& operator=(const HidapiPort&) = delete;

    Read read(std::span<uint8_t> buffer, size_t& size) override {
        const int count = hid_read_timeout(device_, buffer.data(), buffer.size(), 0);
        if (count < 0) return Read::gone;
        size = static_cast<size_t>(count);
        return count > 0 ? Read::report : Read::none;
    }

    bool write(Bytes report) override {
        return hid_write(device_, report.data(), report.size()) >= 0;
    }

    std::vector<uint8_t> feature(uint8_t id, size_t size) override {
        std::vector<uint8_t> report(size);
        report[0] = id;
        const int count = hid_get_feature_report(device_, report.data(), report.size());
        if (count <= 0 || report[0] != id) return {};
        report.resize(std::min(report.size(), static_cast<size_t>(count)));
        return report;
    }

private:
    hid_device* device_;
};

struct OpenFile {
    explicit OpenFile(int opened) : number(opened) {}
    ~OpenFile() {
        if (number >= 0) close(number);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    int number;
};

Bus bus_of(unsigned number) {
    constexpr unsigned usb = 0x03, bluetooth = 0x05; // linux/input.h
    return number == usb ? Bus::usb : number == bluetooth ? Bus::bluetooth : Bus::other;
}

// Lines "KEY=value" of a device, as the kernel writes them.
bool read_uevent(std::istream& file, HidNode& node) {
    bool identified = false;
    for (std::string line; std::getline(file, line);) {
        const size_t equals = line.find('=');
        if (equals == std::string::npos) continue;
        const std::string key = line.substr(0, equals), value = line.substr(equals + 1);
        unsigned bus = 0, vendor = 0, product = 0;
        if (key == "HID_ID"
            && std::sscanf(value.c_str(), "%8x:%8x:%8x", &bus, &vendor, &product) == 3) {
            node.identity = {static_cast<uint16_t>(vendor), static_cast<uint16_t>(product),
                             bus_of(bus)};
            identified = true;
        }
        if (key == "HID_NAME") node.product = value;
        if (key == "HID_UNIQ") node.serial = value;
    }
    return identified;
}

bool is_node_name(const std::string& name) {
    return name.size() > 6 && name.starts_with("hidraw")
           && std::all_of(name.begin() + 6, name.end(),
                          [](char c) { return c >= '0' && c <= '9'; });
}

bool number_before(const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
}

} // namespace

LinuxHid::LinuxHid(std::string devices, std::string nodes)
    : devices_(std::move(devices)), nodes_(std::move(nodes)) {
    hid_init();
}

LinuxHid::~LinuxHid() {
    hid_exit();
}

std::vector<std::string> LinuxHid::names() {
    std::vector<std::string> names;
    std::error_code error;
    for (std::filesystem::directory_iterator at(devices_, error), end; !error && at != end;
         at.increment(error))
        if (is_node_name(at->path().filename().string()))
            names.push_back(at->path().filename().string());
    std::sort(names.begin(), names.end(), number_before);
    return names;
}

bool LinuxHid::describe(const std::string& name, HidNode& node) {
    const std::string device = devices_ + "/" + name + "/device/";
    node = {};
    node.name = name;
    node.path = nodes_ + "/" + name;
    std::ifstream uevent(device + "uevent");
    if (!read_uevent(uevent, node)) return false;
    std::ifstream descriptor(device + "report_descriptor", std::ios::binary);
    node.descriptor.assign(std::istreambuf_iterator<char>(descriptor), {});
    return true;
}

// Asked first what hidapi will ask: it hides why it cannot open a node, and 0.13 leaks memory and
// writes to what it freed when a node turns out to be no HID device (its issue 542).
Opened LinuxHid::open(const HidNode& node) {
    const OpenFile file(::open(node.path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK));
    if (file.number < 0) return {nullptr, errno == EACCES || errno == EPERM};
    int size = 0;
    if (ioctl(file.number, HIDIOCGRDESCSIZE, &size) < 0) return {};
    hid_device* device = hid_open_path(node.path.c_str());
    if (!device) return {};
    return {std::make_unique<HidapiPort>(device), false};
}

} // namespace host::pads
