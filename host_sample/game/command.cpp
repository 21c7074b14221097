#include "command.h"

#include <chrono>
#include <iostream>

#include "../stats.h"
#include "play.h"
#include "unattended.h"

namespace host::game {

namespace {

// Draws how far the level is, now and then.
class Curtain {
public:
    Curtain(Window& window, ui::Ui& ui) : window_(window), ui_(ui) {}

    void show(const char* text, float fraction) {
        const auto now = Clock::now();
        if (text == text_ && now - shown_ < std::chrono::milliseconds(60)) return;
        text_ = text;
        shown_ = now;
        ui::Frame frame;
        window_.framebuffer_size(frame.width, frame.height);
        if (frame.width < 1 || frame.height < 1) return;
        ui_.begin(frame);
        ui_.loading(text, fraction);
        ui_.end_frame();
        window_.present();
    }

private:
    using Clock = std::chrono::steady_clock;

    Window& window_;
    ui::Ui& ui_;
    const char* text_ = nullptr;
    Clock::time_point shown_{};
};

int run_unattended(const Options& options, const gameplay::Replay* replay) {
    Arena arena(options, [](const char*, float) {});
    RoundSetup setup;
    setup.commit = arena.commit();
    setup.hands = replay ? Hands::replay : Hands::bot;
    setup.replay = replay;
    if (replay)
        setup.seed = check_replay(*replay, arena.plan());
    else
        setup.seed = {options.difficulty.value_or(three_cores::Difficulty::normal),
                      options.seed.value_or(1)};
    Round round(arena.stage(), arena.plan(), setup);
    const int status = play_unattended(round);
    if (!options.stats.empty()) write_stats(options.stats, arena.session());
    if (!options.record.empty()) write_replay(round.record(), options.record);
    return status;
}

int run_window(const Options& options, const PlayerSettings& settings, const std::string& note,
               Window& window, const gameplay::Replay* replay) {
    ui::Ui ui(window.modern_gl());
    if (!note.empty()) ui.toast(note);
    Curtain curtain(window, ui);
    Arena arena(options, [&](const char* text, float fraction) { curtain.show(text, fraction); });
    Play(arena, window, ui, settings, replay).run();
    return 0;
}

} // namespace

std::optional<int> run(const Options& options) {
    std::optional<gameplay::Replay> replay;
    if (!options.replay.empty()) replay = read_replay(options.replay);
    const gameplay::Replay* shown = replay ? &*replay : nullptr;
    if (options.headless) return run_unattended(options, shown);

    std::string note, cause;
    const PlayerSettings settings = read_settings(settings_path(), note);
    const int width = options.sized ? static_cast<int>(options.width) : settings.width;
    const int height = options.sized ? static_cast<int>(options.height) : settings.height;
    if (const auto window = Window::open("Three Cores", width, height, !options.sized, cause))
        return run_window(options, settings, note, *window, shown);
    if (!shown && !options.bot) return std::nullopt;
    std::cerr << "no window: " << cause << "; playing without one\n";
    return run_unattended(options, shown);
}

} // namespace host::game
