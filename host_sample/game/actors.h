#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "gameplay/three_cores/game.h"

#include "../effects/effects.h"
#include "../effects/level_effects.h"
#include "aliases.h"
#include "lamps.h"
#include "props.h"
#include "sparks.h"

namespace host::game {

// What is seen of a round beside the level: drones with their beams, cores, grenades, bolts and the
// light of blasts. Queries of the rules do not meet them.
class Actors {
public:
    Actors(Stage& stage, const Props& props, LevelEffects& effects);

    // Seen after the next commit.
    void show(const three_cores::Game& game);
    // What shines in the air as it was shown last, and sparks of what happened since.
    void add_particles(const three_cores::Game& game, std::span<const three_cores::Event> events,
                       std::vector<rt_particle>& particles);
    void choose(Effects effects) { has_effects_ = effects != Effects::plain; }
    void hide();

private:
    void show_drones(const three_cores::Game& game);
    void show_cores(const three_cores::Game& game);

    PropPool drones_, drones_off_, cores_, grenades_, bolts_;
    LampPool lamps_;
    LevelEffects& effects_;
    std::atomic<bool> has_effects_ = true;
    Sparks sparks_;
    std::vector<rt_light_desc> lit_; // kept for its memory
};

} // namespace host::game
