#include "play.h"

#include "../error.h"
#include "../paths.h"
#include "../stats.h"
#include "../stop.h"
#include "backdrop.h"
#include "sentence.h"
#include "unattended.h"

namespace host::game {

namespace {

constexpr double menu_frame = 1.0 / 30, unseen_frame = 0.1; // seconds, at least
constexpr double title_frame = 1.0 / 15; // seconds: the picture behind the title moves slowly

// A snapshot that stays as it is.
class Held {
public:
    explicit Held(Stage& stage) : stage_(stage) {
        stage.check(stage.api().hold_snapshot(stage.scene(), &snapshot_), "holding a snapshot");
    }
    ~Held() { stage_.api().release_snapshot(stage_.scene(), snapshot_); }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    rt_snapshot get() const { return snapshot_; }

private:
    Stage& stage_;
    rt_snapshot snapshot_{};
};

pads::PlayerMappings read_pad_map(const std::string& file) {
    pads::PlayerMappings mappings;
    if (file.empty()) return mappings;
    const std::string mistake = pads::read_player_mappings(file, mappings);
    if (!mistake.empty()) throw InputError(mistake);
    return mappings;
}

} // namespace

Play::Play(Arena& arena, Window& window, ui::Ui& ui, const PlayerSettings& settings,
           const gameplay::Replay* replay)
    : arena_(arena), window_(window), ui_(ui), session_(arena.session()),
      picture_(session_, window), exposure_(session_, night_sight),
      actors_(arena.stage(), load_props(arena.stage(), content_file("props.glb")), arena.effects()),
      pads_(hid_, read_pad_map(session_.options.pad_map)), settings_(settings), applied_(settings),
      kept_(settings), difficulty_chosen_(!session_.options.difficulty) {
    const Options& options = session_.options;
    settings_.difficulty = options.difficulty.value_or(settings.difficulty);
    if (!options.mute) mixer_ = std::make_unique<sound::Mixer>();
    std::string note;
    scores_ = Scores::read(scores_path(), note);
    if (!note.empty()) ui_.toast(note);
    for (const std::string& sentence : ui_.notes()) ui_.toast(sentence);
    apply_settings();
    if (effects() != Effects::plain) baker_ = std::make_unique<LightBaker>(arena.stage());
    if (!replay && !options.bot) return;
    RoundSetup setup = new_setup(replay ? Hands::replay : Hands::bot);
    if (replay) setup.seed = check_replay(*replay, arena.plan());
    setup.replay = replay;
    begin(setup);
}

Play::~Play() = default;

void Play::run() {
    while (!window_.closing() && !is_stopped() && !quitting_ && !done()) frame();
    leave_round();
    if (settings_to_keep() != kept_) keep_settings();
    if (!session_.options.stats.empty()) write_stats(session_.options.stats, session_);
    if (!unsaved_.empty()) throw InputError(unsaved_);
}

bool Play::done() const {
    const auto& frames = session_.options.frames;
    return frames && session_.log.count() >= *frames;
}

void Play::frame() {
    const auto now = Clock::now();
    const double passed = std::chrono::duration<double>(now - before_).count();
    const double seconds = std::min(passed, longest_frame);
    before_ = now;
    const Desk desk = window_.take_desk();
    poll_pads();
    Intent intent = input_.read(desk, pads_.active(), settings_, seconds);
    if (live_ && live_->finish()) collect();
    obey(intent);
    window_.capture_mouse(screen_ == Screen::playing && is_mine());
    if (screen_ == Screen::playing && drawn_ == Screen::playing) pace_.add(passed, seconds);
    show(intent, desk, seconds);
    rest(std::chrono::duration<double>(Clock::now() - now).count());
}

// While playing, frames come as fast as they can. Else nobody waits for them.
void Play::rest(double busy) {
    if (!picture_.visible()) return window_.rest(unseen_frame - busy);
    if (screen_ != Screen::playing) return window_.rest(menu_frame - busy);
    const float chosen = static_cast<float>(settings_.render_scale) / 100.0f;
    picture_.adapt(1000 * busy, session_.options.scale.value_or(chosen));
}

void Play::poll_pads() {
    for (const pads::PadEvent& event : pads_.poll(Clock::now())) {
        ui_.toast(event.text);
        const bool lost = event.kind == pads::PadEvent::Kind::disconnected && event.was_active;
        if (lost && screen_ == Screen::playing) screen_ = Screen::paused;
    }
}

// A key that opens a menu does nothing more in it.
void Play::obey(Intent& intent) {
    const bool left = focused_ && !window_.focused();
    if (!focused_ && window_.focused()) gate_.shut(); // the click that came back is none in a menu
    focused_ = window_.focused();
    wants_screenshot_ |= intent.screenshot;
    if (screen_ != Screen::playing) return;
    if (intent.pause || left || window_.minimised()) screen_ = Screen::paused;
    if (intent.options) open_options();
    if (screen_ != Screen::playing) intent.menu = {};
}

// The picture of a moment, while the next ticks are played, and what is drawn over it.
void Play::show(Intent& intent, const Desk& desk, double seconds) {
    const bool visible = picture_.visible();
    std::vector<glm::dvec3> preview;
    if (live_) preview = live_->preview();
    {
        const Held held(arena_.stage());
        if (screen_ == Screen::playing) {
            blocked_ &= intent.buttons;
            intent.buttons &= ~blocked_;
            live_->advance(intent, seconds);
        } else {
            blocked_ = ~0u;
        }
        view_ = look(seconds);
        if (visible) render(seconds, held.get());
    }
    if (!visible) return;
    draw_over(intent, desk, seconds, preview);
    window_.present();
}

// A picture that stands still is rendered once.
void Play::render(double seconds, rt_snapshot snapshot) {
    rendered_ += seconds;
    const bool due = live_ || rendered_ >= title_frame;
    if (screen_ == Screen::playing || (due && picture_.is_outdated(view_))) {
        exposed_ = exposure_.drift(view_, rendered_);
        arena_.ripples().set_time(live_ ? live_->shown().status.seconds : titled_);
        picture_.show(view_, exposed_, snapshot, shine());
        rendered_ = 0.0;
    } else {
        picture_.repeat();
    }
    if (wants_screenshot_) take_screenshot(snapshot);
}

void Play::take_screenshot(rt_snapshot snapshot) {
    wants_screenshot_ = false;
    try {
        ui_.toast("Wrote " + picture_.write_screenshot(view_, exposed_, snapshot));
    } catch (const InputError& error) {
        ui_.toast(sentence(error.what()));
    }
    before_ = Clock::now(); // what this took is no time of the game
}

// What shines in the air: of the round, or of the level behind the title.
std::span<const rt_particle> Play::shine() {
    if (live_) return live_->shown().particles;
    shining_.clear();
    if (effects() == Effects::plain) return {};
    LevelEffects& level = arena_.effects();
    level.add_particles(titled_, shining_);
    const rt_commit_desc& commit = arena_.commit();
    if (level.describe(titled_, view_.position))
        arena_.stage().commit(commit.structure, commit.quality, nullptr);
    return shining_;
}

Viewpoint Play::look(double seconds) {
    if (live_) return live_->view(settings_.field_of_view);
    titled_ += seconds;
    return backdrop(session_.cameras, titled_);
}

} // namespace host::game
