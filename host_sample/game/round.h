#pragma once

#include <functional>
#include <optional>

#include "gameplay/three_cores/bot.h"
#include "gameplay/three_cores/game.h"

#include "../stage.h"
#include "aliases.h"

namespace host::game {

// The seed of a recorded round: its difficulty in the top byte, the game's seed in the others.
struct RoundSeed {
    three_cores::Difficulty difficulty = three_cores::Difficulty::normal;
    uint64_t seed = 1; // below 2^56

    uint64_t word() const;
    static std::optional<RoundSeed> from_word(uint64_t word); // nothing: no difficulty of ours
};

enum class Hands { player, bot, replay };

struct RoundSetup {
    RoundSeed seed;
    Hands hands = Hands::player;
    const gameplay::Replay* replay = nullptr; // for Hands::replay
    rt_commit_desc commit = rt_default_commit_desc();
};

// Throws InputError, in a sentence, if the replay belongs to another level or another game.
RoundSeed check_replay(const gameplay::Replay& replay, const three_cores::Plan& plan);

// One round: whose hands play it, and a record of it. The scene is committed in every tick.
class Round {
public:
    // Puts the plan's parts back to where they rest.
    Round(Stage& stage, const three_cores::Plan& plan, const RoundSetup& setup);

    // Returns false if there is nothing more to play. `live` is the player's input.
    bool tick(const gameplay::TickInput& live);

    const three_cores::Game& game() const { return game_; }
    const gameplay::Replay& record() const { return record_; }
    const RoundSetup& setup() const { return setup_; }
    bool over() const { return over_; }

    // A replay: the first tick whose state is not the recorded one.
    std::optional<uint64_t> astray() const { return astray_; }

private:
    gameplay::TickInput choose(const gameplay::TickInput& live);

    RoundSetup setup_;
    three_cores::Game game_;
    std::optional<three_cores::Bot> bot_;
    gameplay::Replay record_;
    std::optional<uint64_t> astray_;
    bool over_ = false;
};

} // namespace host::game
