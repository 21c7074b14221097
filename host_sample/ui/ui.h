#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ui/hud.h"
#include "ui/menu.h"
#include "ui/screens.h"

namespace host::ui {

struct Frame {
    int width = 0, height = 0; // of the frame buffer, pixels
    double seconds = 0.0;      // since the frame before
    MenuInput menu;            // presses; ignored while no screen is drawn
    Pointer pointer;
    const Device* device = nullptr; // null: keyboard and mouse, without bindings
};

// HUD and menus over the picture, in the GL context that is current, with Dear ImGui. For one
// frame:
//
//     presenter.show(...);
//     ui.begin(frame);
//     ui.hud(hud);                            // or ui.title(...), ui.pause(...), ...
//     const Action action = ui.pause(pause);  // at most one screen a frame
//     ui.end_frame();                         // draws
//     window.present();
//
// Screens dim the picture themselves. The caller shows the mouse while a screen is drawn and
// captures it else. Opening a screen selects its first entry; coming back from the options does
// not.
class Ui {
public:
    // `modern`: the context is 3.3 or later; else what 2.1 can do. Throws InputError if GL refuses.
    // The same context has to be current whenever one of these is called, the destructor included.
    explicit Ui(bool modern);
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    void begin(const Frame& frame);
    void hud(const Hud& hud);
    Action title(TitleScreen& screen);
    Action pause(const PauseScreen& screen);
    Action options(OptionsScreen& screen);
    Action end(const EndScreen& screen);
    void loading(const std::string& text, float fraction); // instead of a screen
    void end_frame();                                      // draws

    // A sentence at the side for a few seconds ("DualSense connected").
    void toast(std::string sentence);

    // Sounds that the menus ask for since the last call.
    struct MenuSounds {
        bool moved = false, chosen = false;
    };
    MenuSounds take_sounds();

    // Around all texts of the last frame: they should fit the window.
    Box text_box() const;

    // For the player: e.g. that the font is missing and another one is used.
    const std::vector<std::string>& notes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace host::ui
