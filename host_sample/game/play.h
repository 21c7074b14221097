#pragma once

#include <chrono>
#include <memory>

#include "../exposure.h"
#include "../pads/linux_hid.h"
#include "../sound/mixer.h"
#include "../ui/gate.h"
#include "../ui/ui.h"
#include "../window.h"
#include "arena.h"
#include "feedback.h"
#include "light_baker.h"
#include "live_round.h"
#include "pace.h"
#include "picture.h"

namespace host::game {

// The game in a window, from its title to its end.
class Play {
public:
    // `replay` is shown instead of the title, as is a round of the bot; it may be null. Throws
    // InputError or EngineError.
    Play(Arena& arena, Window& window, ui::Ui& ui, const PlayerSettings& settings,
         const gameplay::Replay* replay);
    ~Play();

    // Until it ends. What could not be written is thrown as an InputError when all else is done.
    void run();

private:
    using Clock = std::chrono::steady_clock;
    enum class Screen { title, playing, paused, options, ended };

    // play.cpp: a frame
    bool done() const;
    void frame();
    void poll_pads();
    void obey(Intent& intent);
    void show(Intent& intent, const Desk& desk, double seconds);
    Viewpoint look(double seconds);
    std::span<const rt_particle> shine();
    void render(double seconds, rt_snapshot snapshot);
    void take_screenshot(rt_snapshot snapshot);
    void rest(double busy);

    // play_round.cpp: from the first tick to the last
    RoundSetup new_setup(Hands hands) const;
    void begin(const RoundSetup& setup);
    void collect();
    void end_round();
    void end_replay();
    void leave_round();
    void save_record();

    // play_screens.cpp: what is drawn over the picture
    void draw_over(const Intent& intent, const Desk& desk, double seconds,
                   std::span<const glm::dvec3> preview);
    ui::Action draw_screen();
    void act(ui::Action action);
    void open_options();
    void apply_settings();
    void keep_settings();
    PlayerSettings settings_to_keep() const;
    void make_menu_sounds();

    Effects effects() const { return session_.options.effects.value_or(settings_.effects); }
    bool is_mine() const { return setup_.hands == Hands::player; }

    Arena& arena_;
    Window& window_;
    ui::Ui& ui_;
    Session session_;
    Picture picture_;
    Exposure exposure_;
    Actors actors_;
    pads::LinuxHid hid_;
    pads::PadManager pads_;
    std::unique_ptr<sound::Mixer> mixer_;      // null: --mute
    PlayerSettings settings_, applied_, kept_; // as they are, were applied, and stand in the file
    bool difficulty_chosen_;                   // by the player, not by --difficulty
    Scores scores_;
    Input input_;
    ui::Gate gate_;
    ui::Repeater repeater_;
    Feedback feedback_;
    std::unique_ptr<LightBaker> baker_; // null: plain effects

    Screen screen_ = Screen::title;
    Screen before_options_ = Screen::title;
    Screen drawn_ = Screen::playing; // in the last frame
    RoundSetup setup_;
    std::unique_ptr<LiveRound> live_; // null: the title and what belongs to it
    ui::EndScreen end_;
    Viewpoint view_; // of the last frame
    float exposed_ = 1.0f;
    double titled_ = 0.0;              // seconds that the picture behind the title was shown
    std::vector<rt_particle> shining_; // behind the title
    double rendered_ = 1.0;            // seconds since the last frame that was rendered
    Pace pace_;
    bool told_slow_ = false;
    std::string unsaved_;    // why the last record could not be written
    uint32_t blocked_ = ~0u; // buttons that were held when the round began or went on
    bool focused_ = true, wants_screenshot_ = false, quitting_ = false;
    Clock::time_point before_ = Clock::now();
};

} // namespace host::game
