#pragma once

#include "simulation.h"
#include "ui/hud.h"

namespace host::game {

// What is drawn over the picture. `preview` is the way of the grenade in the hand.
ui::Hud hud_of(const Shown& shown, const three_cores::Rules& rules, const three_cores::Plan& plan,
               const ui::Projection& projection, std::span<const glm::dvec3> preview,
               const std::string& use_key);

} // namespace host::game
