#pragma once

#include <filesystem>
#include <string>

#include "gameplay/three_cores/rules.h"

#include "effects/effects.h"

namespace host {

namespace three_cores = peregrine::three_cores;

// What the player chooses once and finds again.
struct PlayerSettings {
    int width = 1280, height = 720; // of the window while it is not full screen
    bool fullscreen = false;
    int render_scale = 0; // per cent of the window's sides, 25 to 100; 0: as the time allows
    Effects effects = Effects::full;
    int field_of_view = 60;   // degrees, from top to bottom; 45 to 90
    double sensitivity = 1.0; // 0.2 to 3, of mouse and stick
    bool invert_look = false; // up is down
    int volume = 80;          // per cent
    bool vibration = true;
    three_cores::Difficulty difficulty = three_cores::Difficulty::normal;

    bool operator==(const PlayerSettings&) const = default;
};

std::filesystem::path settings_path(); // empty: there is no home

// Defaults for what is missing or of a wrong type; numbers are clamped to their ranges. `note`
// becomes a sentence for the player if something was wrong; nothing throws.
PlayerSettings read_settings(const std::filesystem::path& path, std::string& note);

// Returns a sentence if it cannot be written, else nothing. The game goes on either way.
std::string write_settings(const std::filesystem::path& path, const PlayerSettings& settings);

} // namespace host
