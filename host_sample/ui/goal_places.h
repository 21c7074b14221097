#pragma once

#include <span>
#include <string>
#include <vector>

#include "ui/hud.h"
#include "ui/menu.h"

namespace host::ui {

// Where the mark of a goal is drawn, and its text.
struct GoalPlace {
    glm::vec2 mark{0.0f}; // pixels: the middle of its diamond
    glm::vec2 out{0.0f};  // unit: where its arrow points; 0 while the goal is in view
    Box label;
};

// "CORE  12 m", with the whereabouts of what is not in view.
std::string goal_text(const GoalMark& goal);

// Goals in view are marked where they are. The others are marked at the edge of the window, clear
// of the rows of the HUD above and below. No text lies on another, on a mark or on what is `taken`
// as long as there is room; the nearest goals choose first. `sizes` are those of the texts in
// pixels, `unit` as in theme.h.
std::vector<GoalPlace> place_goals(std::span<const GoalMark> goals,
                                   std::span<const glm::vec2> sizes, glm::vec2 window, float unit,
                                   std::vector<Box> taken);

} // namespace host::ui
