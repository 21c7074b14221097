// How one family of pads is talked to. A driver holds what a conversation needs and does no input
// or output of its own: it is handed reports and a link to answer through.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "descriptor.h"
#include "model.h"
#include "report.h"

namespace host::pads {

using Time = std::chrono::steady_clock::time_point;

class Link {
public:
    virtual ~Link() = default;
    virtual bool write(Bytes report) = 0;
    // A feature report, id first; empty if the device does not answer.
    virtual std::vector<uint8_t> feature(uint8_t id, size_t size) = 0;
};

struct Abilities {
    bool rumble = false, light = false, gyro = false;
};

class Driver {
public:
    virtual ~Driver() = default;

    // Once, after the device was opened. May wait for answers of the device, as short as they are.
    virtual void start(Link&) {}
    // Nothing if the report carries no state.
    virtual std::optional<PadState> receive(Bytes report, const PadState& before) = 0;
    // Often; sends what is due.
    virtual void tick(Link&, Time) {}
    virtual bool send(Link&, Rumble, Color) { return false; }
    virtual Abilities abilities() const { return {}; }
    // The mapping of a pad that its descriptor describes; empty where the layout is known.
    virtual std::string mapping() const { return ""; }
};

constexpr Color resting_light{0, 0, 64};

// Nothing if the device is no pad. "mapping" is the player's own (mapping.h); it is ignored where
// the layout is known.
std::unique_ptr<Driver> make_driver(const Identity& identity, Bytes descriptor,
                                    std::string_view mapping);

std::unique_ptr<Driver> make_dualshock4_driver(const Identity& identity);
std::unique_ptr<Driver> make_dualsense_driver(const Identity& identity);
std::unique_ptr<Driver> make_switch_driver(const Identity& identity);

} // namespace host::pads
