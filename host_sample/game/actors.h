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
    void hide();

private:
    void show_drones(const three_cores::Game& game);
    void show_cores(const three_cores::Game& game);

    PropPool drones_, drones_off_, cores_, grenades_, bolts_;
    LampPool lamps_;
    std::vector<rt_light_desc> lit_; // kept for its memory
};

} // namespace host::game
