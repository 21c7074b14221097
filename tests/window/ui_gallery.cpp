#include <cstdlib>
#include <filesystem>
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "gallery_states.h"
#include "gallery_window.h"
#include "image_file.h"
#include "ui/ui.h"

using namespace host;
using namespace host::ui;
using three_cores::Difficulty;

namespace {

struct Size {
    int width, height;
    bool modern;
};

class Gallery : public testing::TestWithParam<Size> {
protected:
    Gallery() : window_(GetParam().width, GetParam().height, GetParam().modern) {
        if (window_.open()) ui_ = std::make_unique<Ui>(GetParam().modern);
        const char* folder = std::getenv("GALLERY");
        folder_ = folder ? folder : "gallery";
        std::filesystem::create_directories(folder_);
    }
    ~Gallery() override { ui_.reset(); }

    Projection projection() const {
        return Projection(viewpoint(), window_.width(), window_.height());
    }

    Frame frame(double seconds = 0.5) const {
        Frame frame;
        frame.width = window_.width();
        frame.height = window_.height();
        frame.seconds = seconds;
        frame.device = &device_;
        return frame;
    }

    // Draws twice: the first frame is where a screen begins to appear.
    void hang(const std::string& name, const std::function<void()>& draw) {
        window_.show_picture();
        const auto before = window_.read();
        for (int i = 0; i < 2; ++i) {
            window_.show_picture();
            ui_->begin(frame());
            draw();
            ui_->end_frame();
        }
        const auto after = window_.read();
        const std::string size = std::to_string(GetParam().width) + "x"
                                 + std::to_string(GetParam().height)
                                 + (GetParam().modern ? "" : "_gl2");
        write_picture_file(folder_ / (name + "_" + size + ".png"),
                           static_cast<uint32_t>(window_.width()),
                           static_cast<uint32_t>(window_.height()), after);
        expect_drawn(name, before, after);
    }

    void expect_drawn(const std::string& name, const std::vector<uint8_t>& before,
                      const std::vector<uint8_t>& after) const {
        size_t changed = 0, bright = 0;
        for (size_t i = 0; i < before.size(); i += 4) {
            changed += before[i] != after[i] || before[i + 1] != after[i + 1];
            bright += after[i] > 215 && after[i + 1] > 215 && after[i + 2] > 215;
        }
        const size_t pixels = before.size() / 4;
        EXPECT_GT(changed, pixels / 50) << name;
        EXPECT_GT(bright, pixels / 2000) << name << " shows no text";
        const Box box = ui_->text_box();
        EXPECT_GE(box.lower.x, 0.0f) << name;
        EXPECT_GE(box.lower.y, 0.0f) << name;
        EXPECT_LE(box.upper.x, static_cast<float>(window_.width())) << name;
        EXPECT_LE(box.upper.y, static_cast<float>(window_.height())) << name;
    }

    GalleryWindow window_;
    std::unique_ptr<Ui> ui_;
    Device device_ = keyboard();
    std::filesystem::path folder_;
    PlayerSettings settings_;
    Difficulty difficulty_ = Difficulty::normal;
};

TEST_P(Gallery, TheTypefaceOfTheGameIsFound) {
    ASSERT_TRUE(window_.open());
    ui_->begin(frame());
    ui_->end_frame();
    EXPECT_TRUE(ui_->notes().empty()) << ui_->notes().front();
}

TEST_P(Gallery, TitleAndLoading) {
    ASSERT_TRUE(window_.open());
    TitleScreen title{"The hall at night", &difficulty_, BestResult{188.04, 9900}, ""};
    hang("title", [&] { ui_->title(title); });
    title.best.reset();
    title.note = "There will be no sound: no device can be opened.";
    hang("title_noted", [&] { ui_->title(title); });
    hang("loading", [&] { ui_->loading("The hall is being built", 0.4f); });
}

TEST_P(Gallery, Playing) {
    ASSERT_TRUE(window_.open());
    Hud play = calm_hud();
    ui_->toast("DualSense connected");
    hang("play", [&] { ui_->hud(play); });
    ui_->toast(
        "A pad that nobody has heard of, with a name as long as a table is wide, is connected");
    play.hint.text =
        "open the door that leads to the stairs which go down to the cellar below the hall";
    hang("play_long", [&] { ui_->hud(play); });
    ui_->begin(frame(10.0)); // toasts are gone by then
    ui_->end_frame();
    const Hud grenade = arc_hud(projection());
    hang("grenade", [&] { ui_->hud(grenade); });
    const Hud alarm = alarm_hud(projection());
    hang("alarm", [&] { ui_->hud(alarm); });
    const Hud suspicious = suspicious_hud(projection());
    hang("suspicious", [&] { ui_->hud(suspicious); });
    const Hud goals = goals_hud(projection());
    hang("goals", [&] { ui_->hud(goals); });
    const Hud gate = gate_hud(projection());
    hang("gate", [&] { ui_->hud(gate); });
}

TEST_P(Gallery, PauseAndOptions) {
    ASSERT_TRUE(window_.open());
    const PauseScreen pause{"The hall at night", Difficulty::normal};
    hang("pause", [&] { ui_->pause(pause); });
    OptionsScreen options{&settings_};
    hang("options", [&] { ui_->options(options); });
    device_.name = "8BitDo Pro 2";
    device_.accept = "Lower Button";
    device_.back = "Right Button";
    for (Binding& binding : device_.bindings) binding.input = "Left Stick";
    options.has_sound = false;
    hang("options_pad", [&] { ui_->options(options); });
}

TEST_P(Gallery, WonAndLost) {
    ASSERT_TRUE(window_.open());
    hang("won", [&] { ui_->end(won_screen()); });
    hang("lost", [&] { ui_->end(lost_screen()); });
    EndScreen wordy = lost_screen();
    wordy.story = std::string(150, 'x') + ".";
    hang("lost_wordy", [&] { ui_->end(wordy); });
}

// Presses down so often, then the input: what comes of it.
std::set<Action> reached(const std::function<Action(const MenuInput&)>& screen) {
    std::set<Action> actions;
    for (int downs = 0; downs < 12; ++downs) {
        for (const MenuInput& input :
             {MenuInput{.accept = true}, MenuInput{.right = true}, MenuInput{.back = true}})
            actions.insert(screen(input));
        actions.insert(screen({.down = true}));
    }
    actions.erase(Action::none);
    return actions;
}

TEST_P(Gallery, AllActionsAreReachedWithoutAMouse) {
    ASSERT_TRUE(window_.open());
    const auto with = [&](const std::function<Action()>& screen) {
        return reached([&](const MenuInput& input) {
            Frame next = frame(0.02);
            next.menu = input;
            ui_->begin(next);
            const Action action = screen();
            ui_->end_frame();
            return action;
        });
    };
    TitleScreen title{"Hall", &difficulty_, {}, ""};
    OptionsScreen options{&settings_};
    EXPECT_EQ(with([&] { return ui_->title(title); }),
              (std::set{Action::play, Action::options, Action::quit, Action::changed}));
    EXPECT_EQ(with([&] { return ui_->pause({}); }),
              (std::set{Action::resume, Action::restart, Action::options, Action::to_title}));
    const PlayerSettings before = settings_;
    EXPECT_EQ(with([&] { return ui_->options(options); }),
              (std::set{Action::back, Action::changed}));
    EXPECT_NE(settings_, before);
    EXPECT_EQ(with([&] { return ui_->end({}); }), (std::set{Action::restart, Action::to_title}));
}

TEST_P(Gallery, AllEntriesAreReachedByClicks) {
    ASSERT_TRUE(window_.open());
    TitleScreen title{"Hall", &difficulty_, {}, ""};
    std::set<Action> actions;
    for (float y = 0.0f; y < 1.0f; y += 0.02f)
        for (const float x : {0.1f, 0.3f, 0.9f}) {
            Frame next = frame(0.02);
            next.pointer = {
                {x * static_cast<float>(window_.width()), y * static_cast<float>(window_.height())},
                true,
                true,
                true,
                true};
            ui_->begin(next);
            actions.insert(ui_->title(title));
            ui_->end_frame();
        }
    EXPECT_EQ(actions, (std::set{Action::none, Action::play, Action::options, Action::quit,
                                 Action::changed}));
}

// Presses somewhere in the column of sliders, then pulls to the left and to the right end.
TEST_P(Gallery, SlidersAreDragged) {
    ASSERT_TRUE(window_.open());
    OptionsScreen options{&settings_};
    const auto mouse = [&](float x, float y, bool pressed, bool held) {
        Frame next = frame(0.02);
        next.pointer = {glm::vec2(x, y) * glm::vec2(window_.width(), window_.height()), true,
                        pressed, held, true};
        ui_->begin(next);
        ui_->options(options);
        ui_->end_frame();
    };
    const float unit = std::min(static_cast<float>(window_.height()) / 720.0f,
                                static_cast<float>(window_.width()) / 940.0f);
    const float column = (72.0f + 420.0f - 100.0f) * unit / static_cast<float>(window_.width());
    const PlayerSettings before = settings_;
    std::set<int> lowest;
    for (float y = 0.15f; y < 0.9f; y += 0.03f) {
        mouse(column, y, true, true);
        mouse(0.0f, 0.99f, false, true);
        lowest.insert(settings_.volume);
        mouse(1.0f, 0.01f, false, true);
        mouse(1.0f, 0.01f, false, false);
    }
    EXPECT_TRUE(lowest.contains(0));
    EXPECT_EQ(settings_.volume, 100);
    EXPECT_EQ(settings_.field_of_view, 90);
    EXPECT_EQ(settings_.sensitivity, 3.0);
    EXPECT_NE(settings_, before);
}

TEST_P(Gallery, NoWindowIsOfferedThatIsLargerThanTheScreen) {
    ASSERT_TRUE(window_.open());
    OptionsScreen options{&settings_};
    options.most_width = 1366;
    options.most_height = 740;
    std::set<int> widths;
    for (int i = 0; i < 8; ++i) {
        Frame next = frame(0.02);
        next.menu.right = true;
        ui_->begin(next);
        ui_->options(options);
        ui_->end_frame();
        widths.insert(settings_.width);
    }
    EXPECT_EQ(widths, (std::set{640, 960, 1280}));
}

TEST_P(Gallery, OptionsComeBackToTheirEntry) {
    ASSERT_TRUE(window_.open());
    OptionsScreen options{&settings_};
    const auto show = [&](bool pause, const MenuInput& input) {
        Frame next = frame(0.02);
        next.menu = input;
        ui_->begin(next);
        const Action action = pause ? ui_->pause({}) : ui_->options(options);
        ui_->end_frame();
        return action;
    };
    show(true, {.down = true});
    show(true, {.down = true});
    EXPECT_EQ(show(true, {.accept = true}), Action::options);
    EXPECT_EQ(show(false, {.back = true}), Action::back);
    EXPECT_EQ(show(true, {.accept = true}), Action::options);
    ui_->begin(frame());
    ui_->hud({});
    ui_->end_frame();
    EXPECT_EQ(show(true, {.accept = true}), Action::resume);
}

INSTANTIATE_TEST_SUITE_P(Windows, Gallery,
                         testing::Values(Size{1280, 720, true}, Size{1024, 768, true},
                                         Size{640, 480, true}, Size{640, 480, false}));

} // namespace
