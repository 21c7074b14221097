#pragma once

#include <span>
#include <vector>

#include <peregrine/rt.h>

#include "gameplay/three_cores/game.h"

#include "aliases.h"

namespace host::game {

// Sparks of what blasts, breaks, shoots and hits: each burst flies for a while and is gone.
class Sparks {
public:
    // Of the tick that ended so many seconds after the round began.
    void add(std::span<const three_cores::Event> events, double seconds);

    void add_particles(double seconds, std::vector<rt_particle>& particles);

private:
    struct Burst {
        three_cores::Sound cause;
        glm::dvec3 point;
        double seconds;
        uint32_t number;
    };
    std::vector<Burst> bursts_;
    uint32_t count_ = 0; // of the round
};

// The glow about cores, bolts, and drones' thrusters.
void add_glints(const three_cores::Game& game, std::vector<rt_particle>& particles);

} // namespace host::game
