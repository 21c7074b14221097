#pragma once

#include <glm/vec4.hpp>

// Colours and sizes of HUD and menus; lengths in units, of which a window is 720 high (less if it
// is narrow).
namespace host::ui::theme {

using Color = glm::vec4; // sRGB, alpha

constexpr Color text{0.92f, 0.95f, 0.97f, 1.0f};
constexpr Color dim{0.62f, 0.70f, 0.76f, 1.0f};
constexpr Color faint{0.62f, 0.70f, 0.76f, 0.35f};
constexpr Color night{0.012f, 0.022f, 0.038f, 1.0f};
constexpr Color core{0.45f, 0.87f, 1.0f, 1.0f}; // what the cores glow in: the accent
constexpr Color amber{1.0f, 0.73f, 0.28f, 1.0f};
constexpr Color red{1.0f, 0.27f, 0.22f, 1.0f};

constexpr float design_height = 720.0f, design_width = 940.0f;
constexpr float margin = 32.0f;
constexpr float small_text = 19.0f, body_text = 23.0f, heading_text = 44.0f, number_text = 34.0f,
                title_text = 92.0f;

constexpr Color faded(Color color, float alpha) {
    color.a *= alpha;
    return color;
}

constexpr Color mixed(const Color& a, const Color& b, float t) {
    return a + (b - a) * t;
}

// Of drones, as their beams: amber when suspicious, red when alarmed and never before.
constexpr Color mood(float suspicion, bool alarmed) {
    return alarmed ? red : suspicion < 0.5f ? mixed(text, amber, 2.0f * suspicion) : amber;
}

// From nothing to 1: of what is seen, and of a fuse.
constexpr Color danger(float suspicion) {
    return suspicion < 0.5f ? mixed(text, amber, 2.0f * suspicion)
                            : mixed(amber, red, 2.0f * suspicion - 1.0f);
}

} // namespace host::ui::theme
