#include "ui/goal_places.h"
#include "ui/icons.h"
#include "ui/page.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/glm.hpp>

// What the HUD draws at places of the level.
namespace host::ui {

namespace {

constexpr float side_radius = 172.0f; // units: of the ring that points at what is out of view

glm::vec2 towards(float bearing) {
    return {std::sin(bearing), -std::cos(bearing)};
}

void draw_side_mark(const Canvas& canvas, const DroneMark& mark) {
    const glm::vec2 center = 0.5f * canvas.size();
    const Color color = theme::mood(mark.suspicion, mark.alarmed);
    const float half = 0.26f, bearing = mark.sight.bearing;
    canvas.arc(center, side_radius, bearing - half, bearing + half, {0.0f, 0.0f, 0.0f, 0.45f},
               9.0f);
    canvas.arc(center, side_radius, bearing - half, bearing + half, theme::faded(color, 0.3f),
               5.0f);
    const float filled = mark.alarmed ? half : half * mark.suspicion;
    canvas.arc(center, side_radius, bearing - filled, bearing + filled, color, 5.0f);
    const glm::vec2 out = towards(bearing), across(-out.y, out.x);
    const glm::vec2 tip = center + canvas.px(side_radius + 25.0f) * out;
    const glm::vec2 base = center + canvas.px(side_radius + 7.0f) * out;
    const glm::vec2 corners[] = {tip, base + canvas.px(5.5f) * across,
                                 base - canvas.px(5.5f) * across};
    canvas.polygon(corners, color);
}

constexpr float triangle_high = 22.0f, triangle_wide = 13.0f; // units

// Where the triangle of a drone points at it: from above, or from below where it would lie on what
// is taken or out of the window.
struct Tip {
    glm::vec2 place;
    float up; // -1: the triangle is above it; 1: below
    Box box;  // of drone and triangle
};

Tip tip_of(const Canvas& canvas, const DroneMark& mark, std::span<const Box> taken) {
    const glm::vec2 wide(canvas.px(triangle_wide + 2.0f), 0.0f);
    const auto pointing = [&](float up) {
        const float away = mark.radius + canvas.px(10.0f);
        const glm::vec2 place = mark.sight.place + glm::vec2(0.0f, up * away);
        const glm::vec2 base = place + glm::vec2(0.0f, up * canvas.px(triangle_high + 2.0f));
        return Tip{place, up, {glm::min(place, base) - wide, glm::max(place, base) + wide}};
    };
    const Tip above = pointing(-1.0f);
    const bool free = above.box.lower.y >= 0.0f
                      && std::none_of(taken.begin(), taken.end(),
                                      [&](const Box& other) { return above.box.overlaps(other); });
    return free ? above : pointing(1.0f);
}

// A triangle that fills with the drone's suspicion; alarmed it is full and bears a mark.
void draw_drone_mark(const Canvas& canvas, const DroneMark& mark, const Tip& tip) {
    const float high = tip.up * canvas.px(triangle_high), wide = canvas.px(triangle_wide);
    const Color color = theme::mood(mark.suspicion, mark.alarmed);
    const glm::vec2 left(-wide, high), right(wide, high);
    const auto triangle = [&](float part, const Color& fill) {
        const glm::vec2 corners[] = {tip.place, tip.place + part * left, tip.place + part * right};
        canvas.polygon(corners, fill);
    };
    triangle(1.0f, {0.0f, 0.0f, 0.0f, 0.55f});
    triangle(mark.alarmed ? 1.0f : mark.suspicion, color);
    const glm::vec2 outline[] = {tip.place, tip.place + left, tip.place + right};
    canvas.polyline(outline, color, 1.75f, true);
    if (mark.alarmed) {
        const glm::vec2 center = tip.place + glm::vec2(0.0f, 0.64f * high);
        canvas.line(center - glm::vec2(0.0f, canvas.px(6.0f)),
                    center + glm::vec2(0.0f, canvas.px(2.0f)), theme::night, 2.5f);
        canvas.disc(center + glm::vec2(0.0f, canvas.px(6.0f)), 1.5f, theme::night);
    }
    if (mark.charge <= 0.0f) return;
    const float radius = mark.radius / canvas.px(1.0f) + 30.0f - 24.0f * mark.charge; // closes in
    canvas.circle(mark.sight.place, radius, {0.0f, 0.0f, 0.0f, 0.4f}, 4.0f);
    canvas.circle(mark.sight.place, radius, theme::faded(theme::red, 0.5f + 0.5f * mark.charge),
                  2.0f);
}

// Fainter near the hand, where it would hide what is aimed at.
void draw_way(const Canvas& canvas, std::span<const glm::vec2> run) {
    constexpr size_t faint = 6; // points
    for (size_t i = 1; i < std::min(faint, run.size()); ++i)
        canvas.line(run[i - 1], run[i],
                    theme::faded(theme::core, 0.85f * static_cast<float>(i) / faint), 2.5f);
    if (run.size() < faint) return;
    const auto rest = run.subspan(faint - 1);
    canvas.polyline(rest, {0.0f, 0.0f, 0.0f, 0.35f}, 5.0f);
    canvas.polyline(rest, theme::faded(theme::core, 0.9f), 2.5f);
}

void draw_goal(const Canvas& canvas, const GoalPlace& place, const std::string& text) {
    const bool out = place.out != glm::vec2(0.0f);
    canvas.glow(place.mark, 26.0f, theme::faded(theme::core, 0.4f));
    draw_diamond(canvas, place.mark, out ? 7.0f : 9.0f, theme::core, true);
    canvas.text(place.label.lower, Face::small, theme::text, text);
    if (!out) return;
    const glm::vec2 across(-place.out.y, place.out.x);
    const glm::vec2 tip = place.mark + canvas.px(22.0f) * place.out;
    const glm::vec2 base = place.mark + canvas.px(12.0f) * place.out;
    const glm::vec2 corners[] = {tip, base + canvas.px(8.0f) * across,
                                 base - canvas.px(8.0f) * across};
    canvas.polygon(corners, theme::core);
}

void draw_goals(const Canvas& canvas, std::span<const GoalMark> goals, std::vector<Box> taken) {
    std::vector<std::string> texts;
    std::vector<glm::vec2> sizes;
    for (const GoalMark& goal : goals) {
        texts.push_back(goal_text(goal));
        sizes.emplace_back(canvas.width(Face::small, texts.back()), canvas.height(Face::small));
    }
    const auto places = place_goals(goals, sizes, canvas.size(), canvas.px(1.0f), std::move(taken));
    for (size_t i = 0; i < places.size(); ++i) draw_goal(canvas, places[i], texts[i]);
}

bool is_drawn(const DroneMark& mark) {
    return mark.suspicion > 0.0f || mark.alarmed;
}

} // namespace

void show_arc(const Canvas& canvas, const Arc& arc) {
    for (const auto& run : arc.runs) draw_way(canvas, run);
    if (arc.ring.size() > 2) {
        canvas.polyline(arc.ring, {0.0f, 0.0f, 0.0f, 0.35f}, 5.0f, true);
        canvas.polyline(arc.ring, theme::faded(theme::amber, 0.95f), 2.25f, true);
    }
    if (!arc.end) return;
    canvas.glow(*arc.end, 22.0f, theme::faded(theme::amber, 0.6f));
    canvas.disc(*arc.end, 4.5f, theme::amber);
}

void show_marks(const Canvas& canvas, const Hud& hud, std::vector<Box> taken) {
    std::vector<std::pair<const DroneMark*, Tip>> tips;
    const size_t rows = taken.size(); // of the HUD: drones may lie on one another
    for (const DroneMark& mark : hud.drone_marks) {
        if (!is_drawn(mark) || !mark.sight.in_view) continue;
        tips.emplace_back(&mark, tip_of(canvas, mark, std::span(taken).first(rows)));
        taken.push_back(tips.back().second.box);
    }
    const glm::vec2 crosshair(canvas.px(32.0f)), center = 0.5f * canvas.size();
    taken.push_back({center - crosshair, center + crosshair});
    draw_goals(canvas, hud.goals, std::move(taken));
    for (const DroneMark& mark : hud.drone_marks)
        if (is_drawn(mark) && !mark.sight.in_view) draw_side_mark(canvas, mark);
    for (const auto& [mark, tip] : tips) draw_drone_mark(canvas, *mark, tip);
}

} // namespace host::ui
