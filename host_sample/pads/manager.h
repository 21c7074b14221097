// The pads that are plugged in. One thread, the host's: nothing here waits for a pad but the
// greeting of a new one.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "hid.h"
#include "player_mappings.h"
#include "prompts.h"

namespace host::pads {

using PadId = uint32_t; // never used again; 0 is no pad

struct Pad {
    PadId id = 0;
    std::string name, path;
    Family family = Family::generic;
    Bus bus = Bus::other;
    Prompts prompts;
    Abilities abilities;
    PadState state;
    // Since the poll before: also what went down and up again between two frames.
    Buttons pressed, released;
};

struct PadEvent {
    enum class Kind { connected, disconnected, refused } kind;
    PadId id = 0;            // 0: refused
    bool was_active = false; // disconnected: the player held this one; a game pauses
    std::string text;        // a sentence for the player
};

class PadManager {
public:
    explicit PadManager(HidSource& source, PlayerMappings mappings = {});
    ~PadManager(); // stops the motors
    PadManager(const PadManager&) = delete;
    PadManager& operator=(const PadManager&) = delete;

    // Once a frame.
    std::vector<PadEvent> poll(Time now);

    std::vector<const Pad*> pads() const;
    const Pad* find(PadId id) const;
    // The one that was used last: prompts follow it. None before anything was touched.
    const Pad* active() const { return find(active_); }

    // For so many seconds. False if there is no such pad or it has no motors or light.
    bool rumble(PadId id, Rumble rumble, double seconds);
    bool light(PadId id, Color color);

private:
    struct Connection;
    struct Candidate { // a node that is not open
        bool no_pad = false, refused = false;
        Time first_seen{};
    };

    void scan(Time now, std::vector<PadEvent>& events);
    void consider(const std::string& name, Time now, std::vector<PadEvent>& events);
    bool connect(const HidNode& node, std::unique_ptr<Driver> driver, Candidate& candidate,
                 Time now, std::vector<PadEvent>& events);
    bool is_second_way(const HidNode& node) const;
    void disconnect(size_t index, std::vector<PadEvent>& events);
    bool read(Connection& connection);
    void write(Connection& connection, Time now);
    Connection* connection(PadId id) const;

    HidSource& source_;
    PlayerMappings mappings_;
    std::vector<std::unique_ptr<Connection>> connections_;
    std::map<std::string, Candidate> candidates_;
    PadId active_ = 0, last_id_ = 0;
    Time next_scan_{}, now_{};
};

} // namespace host::pads
