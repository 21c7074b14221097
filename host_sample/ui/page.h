#pragma once

#include "ui/canvas.h"
#include "ui/menu.h"
#include "ui/ui.h"

namespace host::ui {

// What a screen works with in one frame.
struct Page {
    Canvas& canvas;
    Menu& menu;
    const MenuInput& input;
    const Pointer& pointer;
    const Device& device;
    Ui::MenuSounds& sounds;
    double now = 0.0; // seconds; for what pulses
};

struct Column {
    glm::vec2 place{0.0f};                                   // pixels
    float width = 380.0f, row = 44.0f, value_width = 190.0f; // units
};

// Dims the picture, more at the left, where the texts are.
void draw_backdrop(const Canvas& canvas, const Color& tint);
// Lays the entries out, lets the player choose, and draws them.
Choice run_column(Page& page, const Column& column, const std::vector<Entry>& entries);
// The buttons' names at the bottom.
void draw_footer(const Page& page, bool has_back);

std::string clock_text(double seconds); // "02:14.5"
std::string score_text(uint32_t score); // "12 350"

Action show_title(Page& page, TitleScreen& screen);
Action show_pause(Page& page, const PauseScreen& screen);
Action show_options(Page& page, OptionsScreen& screen);
Action show_end(Page& page, const EndScreen& screen);
// Marks keep clear of what is `taken`.
void show_hud(const Canvas& canvas, const Hud& hud, double now, std::span<const Box> taken);
void show_marks(const Canvas& canvas, const Hud& hud, std::vector<Box> taken);
void show_arc(const Canvas& canvas, const Arc& arc);

} // namespace host::ui
