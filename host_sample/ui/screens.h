#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scores.h"
#include "settings.h"

// What the menus show. They read these, and change settings and difficulty in place.
namespace host::ui {

enum class Action {
    none,
    play,     // title
    options,  // title, pause
    quit,     // title
    resume,   // pause
    restart,  // pause, won, lost
    to_title, // pause, won, lost
    back,     // options
    changed   // title: the difficulty; options: a setting. Apply it now, write it at `back`
};

// The device in use: prompts follow it.
struct Binding {
    std::string action, input; // "Throw a grenade", "Left mouse button"
};
struct Device {
    std::string name;                           // "Keyboard and mouse", "DualSense"
    std::string accept = "Enter", back = "Esc"; // what its buttons are called
    std::vector<Binding> bindings;              // shown in the options
};

struct TitleScreen {
    std::string level;                   // its name, as players read it
    three_cores::Difficulty* difficulty; // never null
    std::optional<BestResult> best;      // of this level and difficulty
    std::string note;                    // a sentence below; may be empty
};

struct PauseScreen {
    std::string level;
    three_cores::Difficulty difficulty = three_cores::Difficulty::normal;
};

struct OptionsScreen {
    PlayerSettings* settings;                    // never null
    int most_width = 16384, most_height = 16384; // of a window that fits the screen
    bool has_vibration = true;                   // of the device in use
    bool has_sound = true;
};

struct Line { // of the reckoning
    std::string label, value;
};

struct EndScreen {
    bool won = false;
    std::string level;
    three_cores::Difficulty difficulty = three_cores::Difficulty::normal;
    std::string story; // a sentence: how it went, or what ended it
    double seconds = 0.0;
    uint32_t score = 0;
    std::vector<Line> lines;
    std::optional<BestResult> best; // with this round
    bool new_best_time = false, new_best_score = false;
};

} // namespace host::ui
