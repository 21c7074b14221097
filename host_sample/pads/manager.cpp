#include "manager.h"

#include <algorithm>
#include <cmath>

namespace host::pads {

namespace {

using namespace std::chrono_literals;

constexpr auto scan_period = 500ms;
constexpr auto output_period = 10ms;   // more often is more than the radio carries
constexpr auto permission_time = 2s;   // that udev has for a new node
constexpr unsigned most_reports = 256; // of a poll: a quarter of a second of the fastest pad

bool is_use(const PadState& state, Buttons pressed) {
    constexpr float far = 0.5f;
    const auto moved = [&](Stick stick) { return std::hypot(stick.x, stick.y) > far; };
    return pressed.any() || moved(state.left) || moved(state.right) || state.left_trigger > far
           || state.right_trigger > far;
}

} // namespace

struct PadManager::Connection {
    Pad pad;
    HidNode node;
    std::unique_ptr<HidPort> port;
    std::unique_ptr<Driver> driver;
    Rumble rumble;
    Color light = resting_light;
    bool output_due = false;
    Time rumble_end{}, written{};
};

PadManager::PadManager(HidSource& source, PlayerMappings mappings)
    : source_(source), mappings_(std::move(mappings)) {}

PadManager::~PadManager() {
    for (const auto& connection : connections_)
        if (connection->rumble != Rumble{})
            connection->driver->send(*connection->port, {}, connection->light);
}

std::vector<PadEvent> PadManager::poll(Time now) {
    now_ = now;
    std::vector<PadEvent> events;
    for (size_t i = 0; i < connections_.size();) {
        Connection& connection = *connections_[i];
        if (!read(connection)) {
            candidates_.erase(connection.node.name); // the name may come back as another device
            disconnect(i, events);
            continue;
        }
        write(connection, now);
        ++i;
    }
    if (now >= next_scan_) {
        next_scan_ = now + scan_period;
        scan(now, events);
    }
    return events;
}

void PadManager::scan(Time now, std::vector<PadEvent>& events) {
    const std::vector<std::string> names = source_.names();
    const auto is_there = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (size_t i = connections_.size(); i-- > 0;)
        if (!is_there(connections_[i]->node.name)) disconnect(i, events);
    std::erase_if(candidates_, [&](const auto& entry) { return !is_there(entry.first); });
    for (const std::string& name : names) {
        const bool open = std::any_of(connections_.begin(), connections_.end(),
                                      [&](const auto& c) { return c->node.name == name; });
        if (!open) consider(name, now, events);
    }
}

void PadManager::consider(const std::string& name, Time now, std::vector<PadEvent>& events) {
    Candidate& candidate =
        candidates_.try_emplace(name, Candidate{.first_seen = now}).first->second;
    if (candidate.no_pad) return;
    HidNode node;
    if (!source_.describe(name, node)) return;
    const auto own = mappings_.find({node.identity.vendor, node.identity.product});
    auto driver =
        make_driver(node.identity, node.descriptor, own == mappings_.end() ? "" : own->second);
    if (!driver) {
        candidate.no_pad = !node.descriptor.empty(); // an empty one is not there yet
        return;
    }
    if (is_second_way(node)) return;
    if (connect(node, std::move(driver), candidate, now, events)) candidates_.erase(name);
}

// A pad on a cable that also kept its radio on reports twice.
bool PadManager::is_second_way(const HidNode& node) const {
    return !node.serial.empty()
           && std::any_of(connections_.begin(), connections_.end(), [&](const auto& connection) {
                  const HidNode& other = connection->node;
                  return other.serial == node.serial && other.identity.bus != node.identity.bus
                         && other.identity.vendor == node.identity.vendor
                         && other.identity.product == node.identity.product;
              });
}

bool PadManager::connect(const HidNode& node, std::unique_ptr<Driver> driver, Candidate& candidate,
                         Time now, std::vector<PadEvent>& events) {
    Opened opened = source_.open(node);
    if (!opened.port) {
        if (opened.denied && !candidate.refused && now - candidate.first_seen >= permission_time) {
            candidate.refused = true;
            events.push_back({PadEvent::Kind::refused, 0, false, permission_advice(node)});
        }
        return false;
    }
    auto connection = std::make_unique<Connection>();
    connection->node = node;
    connection->port = std::move(opened.port);
    connection->driver = std::move(driver);
    connection->driver->start(*connection->port);
    Pad& pad = connection->pad;
    pad.id = ++last_id_;
    pad.name = node.product.empty() ? family_name(family_of(node.identity)) : node.product;
    pad.path = node.path;
    pad.family = family_of(node.identity);
    pad.bus = node.identity.bus;
    pad.prompts = Prompts(node.identity);
    pad.abilities = connection->driver->abilities();
    events.push_back({PadEvent::Kind::connected, pad.id, false, pad.name + " is connected"});
    connections_.push_back(std::move(connection));
    return true;
}

void PadManager::disconnect(size_t index, std::vector<PadEvent>& events) {
    const Pad& pad = connections_[index]->pad;
    const bool was_active = pad.id == active_;
    events.push_back(
        {PadEvent::Kind::disconnected, pad.id, was_active, pad.name + " is disconnected"});
    if (was_active) active_ = 0;
    connections_.erase(connections_.begin() + static_cast<std::ptrdiff_t>(index));
}

// False: the device is gone.
bool PadManager::read(Connection& connection) {
    Pad& pad = connection.pad;
    pad.pressed = pad.released = {};
    uint8_t buffer[512];
    for (unsigned i = 0; i < most_reports; ++i) {
        size_t size = 0;
        const HidPort::Read result = connection.port->read(buffer, size);
        if (result == HidPort::Read::gone) return false;
        if (result == HidPort::Read::none) break;
        const auto state = connection.driver->receive(Bytes(buffer, size), pad.state);
        if (!state) continue;
        pad.pressed = pad.pressed | state->buttons.without(pad.state.buttons);
        pad.released = pad.released | pad.state.buttons.without(state->buttons);
        pad.state = *state;
        if (is_use(pad.state, pad.pressed)) active_ = pad.id;
    }
    return true;
}

void PadManager::write(Connection& connection, Time now) {
    if (connection.rumble != Rumble{} && now >= connection.rumble_end) {
        connection.rumble = {};
        connection.output_due = true;
    }
    if (connection.output_due && now - connection.written >= output_period) {
        connection.output_due = false;
        connection.written = now;
        connection.driver->send(*connection.port, connection.rumble, connection.light);
    }
    connection.driver->tick(*connection.port, now);
}

std::vector<const Pad*> PadManager::pads() const {
    std::vector<const Pad*> pads;
    for (const auto& connection : connections_) pads.push_back(&connection->pad);
    return pads;
}

const Pad* PadManager::find(PadId id) const {
    const Connection* found = connection(id);
    return found ? &found->pad : nullptr;
}

PadManager::Connection* PadManager::connection(PadId id) const {
    for (const auto& connection : connections_)
        if (connection->pad.id == id) return connection.get();
    return nullptr;
}

bool PadManager::rumble(PadId id, Rumble rumble, double seconds) {
    Connection* found = connection(id);
    if (!found || !found->pad.abilities.rumble) return false;
    constexpr double longest = 60.0;
    const double sane = seconds > 0.0 ? std::min(seconds, longest) : 0.0;
    found->rumble = {std::clamp(rumble.strong, 0.0f, 1.0f), std::clamp(rumble.weak, 0.0f, 1.0f)};
    found->rumble_end =
        now_ + std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(sane));
    found->output_due = true;
    return true;
}

bool PadManager::light(PadId id, Color color) {
    Connection* found = connection(id);
    if (!found || !found->pad.abilities.light) return false;
    found->light = color;
    found->output_due = true;
    return true;
}

} // namespace host::pads
