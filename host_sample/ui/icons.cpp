#include "ui/icons.h"

#include <array>
#include <cmath>
#include <vector>

#include <glm/glm.hpp>

namespace host::ui {

void draw_diamond(const Canvas& canvas, glm::vec2 center, float size, const Color& color,
                  bool filled) {
    const float high = canvas.px(size), wide = 0.72f * high;
    const std::array<glm::vec2, 4> corners = {
        center + glm::vec2(0.0f, -high), center + glm::vec2(wide, 0.0f),
        center + glm::vec2(0.0f, high), center + glm::vec2(-wide, 0.0f)};
    if (filled) canvas.polygon(corners, color);
    canvas.polyline(corners, color, 1.5f, true);
}

// Two halves, each convex.
void draw_heart(const Canvas& canvas, glm::vec2 center, float size, const Color& color) {
    constexpr int steps = 14;
    for (const float side : {-1.0f, 1.0f}) {
        std::vector<glm::vec2> half;
        for (int i = 0; i <= steps; ++i) {
            const float t = 3.14159265f * static_cast<float>(i) / steps;
            const float sine = std::sin(t);
            const float y = 13.0f * std::cos(t) - 5.0f * std::cos(2.0f * t)
                            - 2.0f * std::cos(3.0f * t) - std::cos(4.0f * t);
            half.push_back(center
                           + canvas.px(size) / 16.0f
                                 * glm::vec2(side * 16.0f * sine * sine * sine, -y));
        }
        canvas.polygon(half, color);
    }
}

void draw_grenade(const Canvas& canvas, glm::vec2 center, float size, const Color& color) {
    const float s = canvas.px(size);
    canvas.disc(center + glm::vec2(0.0f, 0.25f * s), 0.68f * size, color);
    canvas.rectangle(center + s * glm::vec2(-0.26f, -0.8f), center + s * glm::vec2(0.26f, -0.3f),
                     color, 1.0f);
    const std::array<glm::vec2, 3> lever = {center + s * glm::vec2(0.1f, -0.75f),
                                            center + s * glm::vec2(0.66f, -0.66f),
                                            center + s * glm::vec2(0.82f, 0.1f)};
    canvas.polyline(lever, color, 0.2f * size);
}

void draw_eye(const Canvas& canvas, glm::vec2 center, float size, float open, float light,
              const Color& color) {
    constexpr int steps = 24;
    const float wide = canvas.px(size), high = wide * (0.12f + 0.5f * open);
    std::vector<glm::vec2> upper, lower;
    for (int i = 0; i <= steps; ++i) {
        const float t = 2.0f * static_cast<float>(i) / steps - 1.0f; // from corner to corner
        const float lid = 1.0f - t * t;
        upper.push_back(center + glm::vec2(wide * t, -high * lid));
        lower.push_back(center + glm::vec2(-wide * t, high * lid));
    }
    std::vector<glm::vec2> lids = upper;
    lids.insert(lids.end(), lower.begin() + 1, lower.end() - 1);
    canvas.polygon(upper, {0.01f, 0.02f, 0.03f, 0.55f});
    canvas.polygon(lower, {0.01f, 0.02f, 0.03f, 0.55f});
    const float iris = std::min(0.4f * size, size * (0.12f + 0.5f * open));
    canvas.disc(center, iris, theme::faded(color, 0.25f + 0.75f * light));
    canvas.disc(center, 0.42f * iris, {0.0f, 0.0f, 0.0f, 0.85f});
    canvas.polyline(lids, color, 2.0f, true);
}

} // namespace host::ui
