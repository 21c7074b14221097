#include "play.h"

#include <utility>

#include "show_hud.h"

namespace host::game {

using ui::Action;

void Play::draw_over(const Intent& intent, const Desk& desk, double seconds,
                     std::span<const glm::dvec3> preview) {
    ui::Frame frame;
    frame.width = picture_.width();
    frame.height = picture_.height();
    frame.seconds = seconds;
    frame.pointer = {desk.pointer, !desk.captured, desk.pressed.has(Key::mouse),
                     desk.held.has(Key::mouse), desk.pointer_moved};
    if (screen_ != drawn_) gate_.shut();
    drawn_ = screen_;
    ui::MenuInput passed = intent.menu;
    gate_.pass(passed, frame.pointer, seconds);
    frame.menu = repeater_.update(passed, seconds);
    frame.device = &input_.device();
    ui_.begin(frame);
    if (live_ && screen_ == Screen::playing) {
        const ui::Projection projection(view_, frame.width, frame.height);
        ui::Hud hud = hud_of(live_->shown(), three_cores::rules_of(setup_.seed.difficulty),
                             arena_.plan(), projection, preview, input_.use_key());
        hud.speed = pace_.speed();
        if (pace_.speed() < 0.8 && !std::exchange(told_slow_, true))
            ui_.toast("Frames take too long here, and time runs slower. Less detail may help.");
        ui_.hud(hud);
    }
    const Action action = draw_screen();
    ui_.end_frame();
    make_menu_sounds();
    act(action);
}

Action Play::draw_screen() {
    switch (screen_) {
    case Screen::title: {
        ui::TitleScreen title{arena_.level_name(), &settings_.difficulty, {}, ""};
        title.best = scores_.best(title.level, settings_.difficulty);
        return ui_.title(title);
    }
    case Screen::paused:
        return ui_.pause({arena_.level_name(), setup_.seed.difficulty});
    case Screen::options: {
        const pads::Pad* pad = input_.uses_pad() ? pads_.active() : nullptr;
        ui::OptionsScreen options{&settings_};
        window_.largest(options.most_width, options.most_height);
        options.has_vibration = pad && pad->abilities.rumble;
        options.has_sound = mixer_ && !mixer_->silent();
        return ui_.options(options);
    }
    case Screen::ended:
        return ui_.end(end_);
    case Screen::playing:
        break;
    }
    return Action::none;
}

void Play::act(Action action) {
    switch (action) {
    case Action::none:
        return;
    case Action::play:
        keep_settings();
        return begin(new_setup(Hands::player));
    case Action::restart:
        return begin(is_mine() ? new_setup(Hands::player) : setup_);
    case Action::options:
        return open_options();
    case Action::resume:
        screen_ = Screen::playing;
        return;
    case Action::to_title:
        leave_round();
        screen_ = Screen::title;
        return;
    case Action::back:
        keep_settings();
        screen_ = before_options_;
        return;
    case Action::changed:
        difficulty_chosen_ = difficulty_chosen_ || screen_ == Screen::title;
        return apply_settings();
    case Action::quit:
        keep_settings();
        quitting_ = true;
        return;
    }
}

void Play::open_options() {
    before_options_ = screen_ == Screen::playing ? Screen::paused : screen_;
    screen_ = Screen::options;
}

void Play::apply_settings() {
    if (mixer_) mixer_->set_volume(settings_.volume / 100.0);
    window_.set_fullscreen(settings_.fullscreen);
    picture_.choose(effects());
    actors_.choose(effects());
    if (settings_.width != applied_.width || settings_.height != applied_.height)
        window_.resize(settings_.width, settings_.height);
    applied_ = settings_;
}

void Play::keep_settings() {
    kept_ = settings_to_keep();
    const std::string mistake = write_settings(settings_path(), kept_);
    if (!mistake.empty()) ui_.toast(mistake);
}

// --difficulty is for this time alone.
PlayerSettings Play::settings_to_keep() const {
    PlayerSettings settings = settings_;
    if (!difficulty_chosen_) settings.difficulty = kept_.difficulty;
    return settings;
}

void Play::make_menu_sounds() {
    const auto sounds = ui_.take_sounds();
    if (!mixer_) return;
    if (sounds.moved) mixer_->play(sound::MenuSound::moved);
    if (sounds.chosen) mixer_->play(sound::MenuSound::chosen);
    const three_cores::Status status = live_ ? live_->shown().status : three_cores::Status();
    mixer_->set_mood(status.alarmed ? 1.0 : status.alarm, screen_ != Screen::playing);
    if (const auto note = mixer_->take_note()) ui_.toast(*note);
}

} // namespace host::game
