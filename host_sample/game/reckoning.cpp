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

// What was remarkable, the best of it first.
std::string story_of(const three_cores::Status& status, uint32_t lives_total) {
    const std::string yours = status.cores_total == 0   ? "You are away"
                              : status.cores_total == 1 ? "The core is yours"
                              : status.cores_total == 3 ? "All three cores are yours"
                                                        : "All cores are yours";
    if (status.alarms == 0 && status.lives == lives_total)
        return yours
               + (status.drones == status.drones_total ? ", and the night keeps quiet."
                                                       : ", and no drone knows who it was.");
    if (status.drones == 0 && status.drones_total > 0)
        return yours + ", and no drone is left to tell.";
    if (status.lives == 1 && lives_total > 1) return yours + ". It was your last life.";
    if (status.alarms > 1)
        return yours + ", but drones were alarmed " + std::to_string(status.alarms) + " times.";
    return yours + (status.alarms == 1 ? ", but a drone was alarmed." : ", at a price.");
}

ui::EndScreen reckon(const Shown& shown, const three_cores::Game& game) {
    const three_cores::Status& status = shown.status;
    ui::EndScreen end;
    end.won = status.outcome == three_cores::Outcome::won;
    end.seconds = status.seconds;
    end.score = status.score;
    end.story = end.won ? story_of(status, game.rules().lives) : cause_of(game);
    end.lines = {{"Cores", of(status.cores, status.cores_total)},
                 {"Drones disabled", of(status.drones_total - status.drones, status.drones_total)},
                 {"Alarms", std::to_string(status.alarms)},
                 {"Lives left", std::to_string(status.lives)},
                 {"Grenades left", std::to_string(status.grenades)}};
    return end;
}

} // namespace host::game
