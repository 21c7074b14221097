// The whole way: a device of the kernel, its driver, its node, hidapi, the manager, and back to the
// device's motors. Run in a virtual machine by "run". The last line is "VERDICT pass" if all is
// well.
#include <chrono>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

#include "../descriptors.h"
#include "pads/crc32.h"
#include "pads/linux_hid.h"
#include "pads/listing.h"
#include "pads/manager.h"
#include "uhid_pad.h"

namespace host::pads::test {
namespace {

using namespace std::chrono_literals;
using Kind = PadEvent::Kind;

void require(bool fine, const std::string& what) {
    std::printf("%s %s\n", fine ? "ok  " : "FAIL", what.c_str());
    std::fflush(stdout);
    if (!fine) throw std::runtime_error(what);
}

class Game {
public:
    // Polls as a game does until it is so, at most a minute: an emulated machine is slow.
    void until(const std::string& what, const std::function<bool()>& done) {
        const auto end = std::chrono::steady_clock::now() + 60s;
        bool fine = done();
        while (!fine && std::chrono::steady_clock::now() < end) {
            for (const PadEvent& event : manager.poll(std::chrono::steady_clock::now()))
                events.push_back(event);
            fine = done();
            std::this_thread::sleep_for(5ms);
        }
        require(fine, what);
    }

    const Pad& connected() {
        events.clear();
        until("the manager sees it plugged in", [&] { return !events.empty(); });
        require(events[0].kind == Kind::connected, events[0].text);
        return *manager.find(events[0].id);
    }

    void disconnected(PadId id) {
        events.clear();
        until("the manager sees it pulled out", [&] { return !events.empty(); });
        require(events[0].kind == Kind::disconnected && events[0].id == id, events[0].text);
        require(manager.pads().empty() && !manager.find(id), "it is gone");
    }

    LinuxHid hid;
    PadManager manager{hid};
    std::vector<PadEvent> events;
};

// Declares the reports that the pad has; what is in them the driver knows.
std::vector<uint8_t> dualsense_descriptor(Bus bus) {
    const std::string features = "85 05 09 22 95 28 b1 02 85 09 09 24 95 13 b1 02 "
                                 "85 20 09 26 95 3f b1 02 c0";
    const std::string head = "05 01 09 05 a1 01 15 00 26 ff 00 75 08 06 00 ff ";
    return bus == Bus::usb
               ? bytes(head + "85 01 09 20 95 3f 81 02 85 02 09 23 95 3e 91 02 " + features)
               : bytes(head + "85 01 09 20 95 09 81 02 85 31 09 21 95 4d 81 02 09 23 95 4d 91 02 "
                       + features);
}

void sign(std::vector<uint8_t>& report, uint8_t header) {
    const size_t end = report.size() - 4;
    const uint32_t crc = crc32(header, Bytes(report).first(end));
    for (size_t i = 0; i < 4; ++i) report[end + i] = static_cast<uint8_t>(crc >> 8 * i);
}

UhidDescription dualsense(Bus bus) {
    UhidDescription pad;
    pad.name = "Sony DualSense of nobody";
    pad.identity = {0x054c, 0x0ce6, bus};
    pad.descriptor = dualsense_descriptor(bus);
    pad.features[0x05] = bytes("05 ..6 40 1f c0 e0 40 1f c0 e0 40 1f c0 e0 1c 02 1c 02 "
                               "00 20 00 e0 00 20 00 e0 00 20 00 e0 ..6");
    pad.features[0x09] = bytes("09 01 02 03 04 05 06 ..13");
    pad.features[0x20] = bytes("20 ..63");
    if (bus == Bus::bluetooth)
        for (auto& [id, report] : pad.features) sign(report, 0xa3);
    return pad;
}

// Left stick up, L2 half, cross, R1.
std::vector<uint8_t> dualsense_input(Bus bus) {
    auto report = bytes(bus == Bus::usb ? "01" : "31 10");
    const auto body = bytes("80 00 80 80 80 00 01 28 02");
    report.insert(report.end(), body.begin(), body.end());
    report.resize(bus == Bus::usb ? 64 : 78);
    if (bus == Bus::bluetooth) sign(report, bluetooth_input);
    return report;
}

void try_dualsense(Game& game, Bus bus) {
    std::printf("DualSense, %s\n", bus_name(bus));
    auto device = std::make_unique<UhidPad>(dualsense(bus));
    const Pad& pad = game.connected();
    require(pad.family == Family::dualsense && pad.bus == bus, "it is a DualSense there");
    std::fputs(list_pads(game.hid).c_str(), stdout);

    game.until("the cross and its companions arrive", [&] {
        device->input(dualsense_input(bus));
        return pad.state.buttons == buttons(Button::south, Button::right_shoulder);
    });
    require(pad.state.left == Stick{0.0f, 1.0f}, "the left stick is up");
    require(pad.state.left_trigger > 0.49f && pad.state.left_trigger < 0.51f, "L2 is halfway");
    require(game.manager.active() == &pad, "it is the pad in use");

    const size_t flags = bus == Bus::usb ? 1 : 3;
    const auto arrived = [&](uint8_t weak, uint8_t strong, uint8_t blue) {
        for (const auto& report : device->outputs()) {
            const bool whole = report.size() == (bus == Bus::usb ? 63u : 78u);
            if (!whole || report[flags + 1] != 0x04) continue; // the kernel's own
            auto again = report;
            if (bus == Bus::bluetooth) sign(again, bluetooth_output);
            if (again == report && report[flags + 2] == weak && report[flags + 3] == strong
                && report[flags + 46] == blue)
                return true;
        }
        return false;
    };
    require(game.manager.rumble(pad.id, {1.0f, 0.5f}, 0.3), "it has motors");
    require(game.manager.light(pad.id, {0, 0, 77}), "it has a light");
    game.until("motors and light reach the device", [&] { return arrived(128, 255, 77); });
    game.until("the motors end by themselves", [&] { return arrived(0, 0, 77); });

    const PadId id = pad.id;
    device.reset();
    game.disconnected(id);
    require(game.events[0].was_active, "a game would pause");
}

void try_generic(Game& game) {
    std::puts("a pad that only its descriptor describes");
    UhidDescription description;
    description.name = "Pad of nobody";
    description.identity = {0x1209, 0x0001, Bus::usb};
    description.descriptor = plain_descriptor();
    auto device = std::make_unique<UhidPad>(description);
    const Pad& pad = game.connected();
    require(pad.family == Family::generic && pad.name == "Pad of nobody", "it is a generic pad");
    std::fputs(list_pads(game.hid).c_str(), stdout);
    game.until("hat, buttons and sticks arrive", [&] {
        device->input(bytes("ff 80 80 00 22 20 00 00"));
        return pad.state.buttons == buttons(Button::right, Button::south, Button::start);
    });
    require(pad.state.left == Stick{1.0f, 0.0f} && pad.state.right == Stick{0.0f, 1.0f}, "sticks");
    require(!game.manager.rumble(pad.id, {1.0f, 1.0f}, 1.0), "it has no motors");
    const PadId id = pad.id;
    device.reset();
    game.disconnected(id);
}

void try_eightbitdo(Game& game) {
    std::puts("an 8BitDo pad with motors");
    UhidDescription description;
    description.name = "8BitDo of nobody";
    description.identity = {0x2dc8, 0x6001, Bus::usb};
    description.descriptor = numbered_descriptor();
    for (size_t i = 0; i + 1 < description.descriptor.size(); ++i)
        if (description.descriptor[i] == 0x85 && description.descriptor[i + 1] == 9)
            description.descriptor[i + 1] = 5;
    auto device = std::make_unique<UhidPad>(description);
    const Pad& pad = game.connected();
    game.until("the A of the east arrives", [&] {
        device->input(bytes("05 00 00 00 01 00 00"));
        return pad.state.buttons == buttons(Button::east);
    });
    require(game.manager.rumble(pad.id, {1.0f, 0.0f}, 0.3), "it has motors");
    game.until("the motors' report reaches the device", [&] {
        for (const auto& report : device->outputs())
            if (report == bytes("05 ff 00 00 00")) return true;
        return false;
    });
    const PadId id = pad.id;
    device.reset();
    game.disconnected(id);
}

// Somebody who is not root, and no rule.
void try_without_permission() {
    std::puts("without permission");
    UhidDescription description;
    description.name = "Locked pad";
    description.identity = {0x1209, 0x0002, Bus::usb};
    description.descriptor = plain_descriptor();
    UhidPad device(description);
    std::this_thread::sleep_for(1s);
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        if (setuid(65534) != 0) _exit(2);
        int status = 1;
        try {
            Game game;
            game.until("a sentence about the rule", [&] {
                return !game.events.empty() && game.events[0].kind == Kind::refused;
            });
            std::puts(game.events[0].text.c_str());
            status = 0;
        } catch (const std::exception&) {
        }
        std::fflush(stdout);
        _exit(status);
    }
    int status = 1;
    waitpid(child, &status, 0);
    require(WIFEXITED(status) && WEXITSTATUS(status) == 0, "it was refused with a sentence");
}

} // namespace
} // namespace host::pads::test

int main() {
    using namespace host::pads;
    try {
        test::Game game;
        test::try_dualsense(game, Bus::usb);
        test::try_dualsense(game, Bus::bluetooth);
        test::try_generic(game);
        test::try_eightbitdo(game);
        test::try_without_permission();
    } catch (const std::exception& error) {
        std::printf("%s\nVERDICT fail\n", error.what());
        return 1;
    }
    std::puts("VERDICT pass");
    return 0;
}
