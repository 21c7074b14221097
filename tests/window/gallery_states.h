#pragma once

#include "ui/ui.h"

// What the screens of the gallery show: moments of a game that nobody played.
namespace host::ui {

Viewpoint viewpoint();
Device keyboard();
Hud calm_hud();
Hud arc_hud(const Projection& projection);
Hud alarm_hud(const Projection& projection);
Hud gate_hud(const Projection& projection);
Hud suspicious_hud(const Projection& projection);
Hud goals_hud(const Projection& projection);
EndScreen won_screen();
EndScreen lost_screen();

} // namespace host::ui
