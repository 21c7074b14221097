#include "round.h"

#include "../error.h"

namespace host::game {

namespace {

using three_cores::Difficulty;

constexpr uint32_t seed_bits = 56;
constexpr uint64_t seed_mask = (uint64_t{1} << seed_bits) - 1;

void put_to_rest(Stage& stage, const three_cores::Part& part) {
    for (const rt_mesh mesh : part.meshes)
        stage.check(stage.api().set_mesh_transform(stage.scene(), mesh, &part.rest),
                    "moving a part of the level");
}

// The game takes for granted that everything is where the file has it.
const three_cores::Plan& put_to_rest(Stage& stage, const three_cores::Plan& plan) {
    for (const auto* parts : {&plan.doors, &plan.crates, &plan.gates})
        for (const three_cores::Part& part : *parts) put_to_rest(stage, part);
    for (const three_cores::LiftPlan& lift : plan.lifts) put_to_rest(stage, lift.part);
    return plan;
}

three_cores::Settings settings_of(const RoundSetup& setup) {
    return {setup.seed.difficulty, setup.seed.seed, setup.commit};
}

} // namespace

uint64_t RoundSeed::word() const {
    return static_cast<uint64_t>(difficulty) << seed_bits | (seed & seed_mask);
}

std::optional<RoundSeed> RoundSeed::from_word(uint64_t word) {
    const uint64_t difficulty = word >> seed_bits;
    if (difficulty > static_cast<uint64_t>(Difficulty::hard)) return std::nullopt;
    return RoundSeed{static_cast<Difficulty>(difficulty), word & seed_mask};
}

RoundSeed check_replay(const gameplay::Replay& replay, const three_cores::Plan& plan) {
    if (replay.level != plan.level)
        throw InputError("the replay was played in another level, or in another version of this "
                         "one; --scene FILE chooses the level");
    if (replay.ticks_per_second != three_cores::kTicksPerSecond)
        throw InputError("the replay has " + std::to_string(replay.ticks_per_second)
                         + " ticks a second, and this game has "
                         + std::to_string(three_cores::kTicksPerSecond));
    const auto seed = RoundSeed::from_word(replay.seed);
    if (!seed) throw InputError("the replay has a difficulty that this game does not know");
    return *seed;
}

Round::Round(Stage& stage, const three_cores::Plan& plan, const RoundSetup& setup)
    : setup_(setup),
      game_(stage.api(), stage.scene(), put_to_rest(stage, plan), settings_of(setup)) {
    record_.ticks_per_second = three_cores::kTicksPerSecond;
    record_.seed = setup.seed.word();
    record_.level = plan.level;
    if (setup.hands == Hands::bot) bot_.emplace(game_);
}

bool Round::tick(const gameplay::TickInput& live) {
    const bool ended = game_.status().outcome != three_cores::Outcome::playing;
    const size_t played = record_.ticks.size();
    const bool out = setup_.hands == Hands::replay && played == setup_.replay->ticks.size();
    over_ = ended || out;
    if (over_) return false;
    const gameplay::TickInput input = choose(live);
    game_.tick(input);
    const gameplay::Tick tick{input, game_.hash()};
    if (setup_.hands == Hands::replay && !astray_ && tick.hash != setup_.replay->ticks[played].hash)
        astray_ = played;
    record_.ticks.push_back(tick);
    return true;
}

gameplay::TickInput Round::choose(const gameplay::TickInput& live) {
    switch (setup_.hands) {
    case Hands::replay:
        return setup_.replay->ticks[record_.ticks.size()].input;
    case Hands::bot:
        return bot_->next(game_);
    case Hands::player:
        break;
    }
    return live;
}

} // namespace host::game
