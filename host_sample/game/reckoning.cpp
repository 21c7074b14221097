#include "reckoning.h"

namespace host::game {

namespace {

// The last hit was in the last tick.
std::string cause_of(const three_cores::Game& game) {
    for (const three_cores::Event& event : game.events())
        if (event.sound == three_cores::Sound::blast) return "Your own grenade was too close.";
    if (game.player().state().position.y < game.plan().lower.y) return "You fell out of the level.";
    return "A drone shot you down.";
}

std::string of(uint32_t part, uint32_t all) {
    return std::to_string(part) + " of " + std::to_string(all);
}

} // namespace

ui::EndScreen reckon(const Shown& shown, const three_cores::Game& game) {
    const three_cores::Status& status = shown.status;
    ui::EndScreen end;
    end.won = status.outcome == three_cores::Outcome::won;
    end.seconds = status.seconds;
    end.score = status.score;
    if (!end.won) end.cause = cause_of(game);
    end.lines = {{"Cores", of(status.cores, status.cores_total)},
                 {"Drones disabled", of(status.drones_total - status.drones, status.drones_total)},
                 {"Lives left", std::to_string(status.lives)},
                 {"Grenades left", std::to_string(status.grenades)}};
    return end;
}

} // namespace host::game
