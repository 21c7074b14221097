#pragma once

#include "ui/canvas.h"

// Small pictures; sizes in units.
namespace host::ui {

void draw_diamond(const Canvas& canvas, glm::vec2 center, float size, const Color& color,
                  bool filled);
void draw_heart(const Canvas& canvas, glm::vec2 center, float size, const Color& color);
void draw_grenade(const Canvas& canvas, glm::vec2 center, float size, const Color& color);
// `open` from 0, nearly shut, to 1; `light` is how much of the iris shines.
void draw_eye(const Canvas& canvas, glm::vec2 center, float size, float open, float light,
              const Color& color);

} // namespace host::ui
