#pragma once

#include "gameplay/three_cores/floors.h"
#include "gameplay/three_cores/game.h"

namespace peregrine::three_cores {

// Plays the game by what a player can see and press: walks to the nearest core by known floors,
// opens doors, throws grenades at drones that it sees, and runs when it is shot at.
class Bot {
public:
    // Looks at the whole level first, which takes a moment.
    explicit Bot(const Game& game);

    gameplay::TickInput next(const Game& game);

private:
    struct Throw {
        Vec3 view{0};
        double miss = 1e30; // m, from where it goes off to the drone
    };

    std::optional<Vec3> goal(const Game& game) const;
    void plan_way(const Game& game);
    Vec3 walk(const Game& game);
    const Drone* prey(const Game& game) const;
    Throw best_throw(const Game& game, const Drone& drone) const;
    void fight(const Game& game, gameplay::TickInput& input);
    void get_unstuck(const Game& game, gameplay::TickInput& input);

    Floors floors_;
    std::vector<Vec3> way_;
    size_t at_ = 0;               // the place of the way to go to
    std::optional<Vec3> heading_; // what the way leads to
    Vec3 anchor_{0};
    uint64_t anchored_ = 0; // tick
    uint64_t rest_until_ = 0;
    bool cooking_ = false;
};

} // namespace peregrine::three_cores
