#include "uhid_pad.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <linux/input.h>
#include <linux/uhid.h>
#include <poll.h>
#include <unistd.h>

namespace host::pads::test {

namespace {

void send(int file, const uhid_event& event) {
    if (write(file, &event, sizeof event) != static_cast<ssize_t>(sizeof event))
        throw std::runtime_error("the kernel does not take the event of a virtual gamepad");
}

void copy_text(const std::string& text, unsigned char* to, size_t size) {
    std::copy_n(text.begin(), std::min(text.size(), size - 1), to);
}

} // namespace

UhidPad::UhidPad(const UhidDescription& description)
    : features_(description.features), file_(open("/dev/uhid", O_RDWR | O_CLOEXEC)) {
    if (file_ < 0) throw std::runtime_error("/dev/uhid cannot be opened");
    uhid_event event{};
    event.type = UHID_CREATE2;
    uhid_create2_req& create = event.u.create2;
    copy_text(description.name, create.name, sizeof create.name);
    copy_text(description.serial, create.uniq, sizeof create.uniq);
    create.rd_size = static_cast<uint16_t>(description.descriptor.size());
    create.bus = description.identity.bus == Bus::bluetooth ? BUS_BLUETOOTH : BUS_USB;
    create.vendor = description.identity.vendor;
    create.product = description.identity.product;
    std::copy(description.descriptor.begin(), description.descriptor.end(), create.rd_data);
    send(file_, event);
    thread_ = std::thread([this] { serve(); });
}

UhidPad::~UhidPad() {
    stop_ = true;
    thread_.join();
    close(file_);
}

void UhidPad::input(const std::vector<uint8_t>& report) {
    uhid_event event{};
    event.type = UHID_INPUT2;
    event.u.input2.size = static_cast<uint16_t>(report.size());
    std::copy(report.begin(), report.end(), event.u.input2.data);
    send(file_, event);
}

std::vector<std::vector<uint8_t>> UhidPad::outputs() const {
    const std::lock_guard lock(mutex_);
    return outputs_;
}

// A thread of its own: whoever asks for a feature report waits for the answer.
void UhidPad::serve() {
    while (!stop_) {
        pollfd waiting{file_, POLLIN, 0};
        if (poll(&waiting, 1, 50) <= 0) continue;
        uhid_event event{};
        if (read(file_, &event, sizeof event) <= 0) continue;
        if (event.type == UHID_GET_REPORT) answer(event.u.get_report.id, event.u.get_report.rnum);
        if (event.type == UHID_SET_REPORT) {
            uhid_event reply{};
            reply.type = UHID_SET_REPORT_REPLY;
            reply.u.set_report_reply.id = event.u.set_report.id;
            send(file_, reply);
        }
        if (event.type == UHID_OUTPUT) {
            const std::lock_guard lock(mutex_);
            const uint8_t* data = &event.u.output.data[0];
            outputs_.emplace_back(data, data + event.u.output.size);
        }
    }
}

void UhidPad::answer(uint32_t id, uint8_t report) {
    uhid_event event{};
    event.type = UHID_GET_REPORT_REPLY;
    event.u.get_report_reply.id = id;
    const auto found = features_.find(report);
    if (found == features_.end()) {
        event.u.get_report_reply.err = EIO;
    } else {
        event.u.get_report_reply.size = static_cast<uint16_t>(found->second.size());
        std::copy(found->second.begin(), found->second.end(), event.u.get_report_reply.data);
    }
    send(file_, event);
}

} // namespace host::pads::test
