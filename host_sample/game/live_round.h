#pragma once

#include "gameplay/fixed_step.h"

#include "input.h"
#include "look.h"
#include "pace.h"
#include "simulation.h"

namespace host::game {

// A round in a window: real time becomes ticks, ticks become a view.
class LiveRound {
public:
    LiveRound(Stage& stage, const three_cores::Plan& plan, const RoundSetup& setup, Actors& actors);

    // Waits for the ticks that run. True if shown() is new.
    bool finish() { return simulation_.finish(); }

    // Looks around and begins the ticks that are due. After finish().
    void advance(const Intent& intent, double seconds);

    // Where the player is between the last two ticks, looking where the mouse says, or where those
    // look who play instead.
    Viewpoint view(double field_of_view) const;

    // The way of the grenade in the hand; empty: none. After finish(), before advance().
    std::vector<glm::dvec3> preview() const;

    const Shown& shown() const { return simulation_.shown(); }
    const Round& round() const { return round_; } // after finish(), before advance()

private:
    // All that a frame may play, and the rest of the one before.
    static constexpr auto most_ticks =
        static_cast<uint32_t>(longest_frame * three_cores::kTicksPerSecond) + 1;

    bool is_mine() const { return setup_hands_ == Hands::player; }

    Hands setup_hands_;
    Round round_;
    Simulation simulation_;
    Look look_;
    gameplay::FixedStep steps_{three_cores::kTicksPerSecond, most_ticks};
    double blend_ = 1, next_blend_ = 1; // of the ticks that are shown, and of those that run
    uint32_t waiting_ = 0;              // buttons that no tick has seen yet
};

} // namespace host::game
