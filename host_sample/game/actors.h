#pragma once

#include "gameplay/three_cores/game.h"

#include "aliases.h"
#include "lamps.h"
#include "props.h"

namespace host::game {

// What is seen of a round beside the level: drones with their beams, cores, grenades, bolts and the
// light of blasts. Queries of the rules do not meet them.
class Actors {
public:
    Actors(Stage& stage, const Props& props);

    // Seen after the next commit.
    void show(const three_cores::Game& game);
    void note(std::span<const three_cores::Event> events); // of a tick
    void hide();

private:
    struct Blast {
        glm::dvec3 point;
        double age; // ticks
    };
    void show_drones(const three_cores::Game& game);
    void show_cores(const three_cores::Game& game);
    void show_blasts(const three_cores::Game& game);

    PropPool drones_, drones_off_, cores_, grenades_, bolts_;
    LampPool lamps_;
    std::vector<Blast> blasts_;
    std::vector<rt_light_desc> lit_; // kept for its memory
    uint64_t last_tick_ = 0;
};

} // namespace host::game
