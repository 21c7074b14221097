#include "play.h"

#include <random>

#include "../error.h"
#include "reckoning.h"
#include "sentence.h"
#include "unattended.h"

namespace host::game {

namespace {

constexpr uint64_t seeds = uint64_t{1} << 32; // as many as a player can tell another

} // namespace

RoundSetup Play::new_setup(Hands hands) const {
    RoundSetup setup;
    setup.hands = hands;
    setup.commit = arena_.commit();
    setup.seed.difficulty = settings_.difficulty;
    setup.seed.seed =
        session_.options.seed ? *session_.options.seed : std::random_device()() % seeds;
    return setup;
}

void Play::begin(const RoundSetup& setup) {
    leave_round();
    setup_ = setup;
    live_ = std::make_unique<LiveRound>(arena_.stage(), arena_.plan(), setup, actors_);
    input_.reset();
    blocked_ = ~0u;
    pace_.reset();
    before_ = Clock::now();
    screen_ = Screen::playing;
}

// What happened in the ticks that are over.
void Play::collect() {
    const Shown& shown = live_->shown();
    const Viewpoint view = live_->view(settings_.field_of_view);
    if (mixer_) mixer_->play({view.position, view.forward, view.up}, shown.events);
    feedback_.update(pads_, shown, settings_.vibration);
    if (screen_ == Screen::ended) return;
    if (shown.status.outcome != three_cores::Outcome::playing)
        end_round();
    else if (shown.over)
        end_replay();
}

void Play::end_round() {
    end_ = reckon(live_->shown(), live_->round().game());
    end_.level = arena_.level_name();
    end_.difficulty = setup_.seed.difficulty;
    if (end_.won && is_mine()) {
        const auto improved = scores_.add(end_.level, end_.difficulty, {end_.seconds, end_.score});
        end_.new_best_time = improved.time;
        end_.new_best_score = improved.score;
        const std::string mistake = scores_.write(scores_path());
        if (!mistake.empty()) ui_.toast(mistake);
    }
    end_.best = scores_.best(end_.level, end_.difficulty);
    screen_ = Screen::ended;
    save_record();
}

void Play::end_replay() {
    ui_.toast("The replay has ended.");
    leave_round();
    screen_ = Screen::title;
}

void Play::leave_round() {
    if (!live_) return;
    live_->finish();
    if (live_->round().astray())
        ui_.toast("The replay went astray in tick " + std::to_string(*live_->round().astray())
                  + ".");
    if (screen_ != Screen::ended) save_record();
    live_.reset();
    actors_.hide();
}

// The game goes on if it cannot be written; run() tells in the end.
void Play::save_record() {
    const std::string& file = session_.options.record;
    const gameplay::Replay& record = live_->round().record();
    if (file.empty() || setup_.hands == Hands::replay || record.ticks.empty()) return;
    try {
        write_replay(record, file);
        unsaved_.clear();
    } catch (const InputError& error) {
        unsaved_ = error.what();
        ui_.toast(sentence(unsaved_));
    }
}

} // namespace host::game
