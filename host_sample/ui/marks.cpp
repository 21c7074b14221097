#include "ui/icons.h"
#include "ui/page.h"

#include <algorithm>
#include <cmath>

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
    const Color color = theme::danger(mark.suspicion);
    const float half = 0.26f, bearing = mark.sight.bearing;
    canvas.arc(center, side_radius, bearing - half, bearing + half, {0.0f, 0.0f, 0.0f, 0.45f},
               9.0f);
    canvas.arc(center, side_radius, bearing - half, bearing + half, theme::faded(color, 0.3f),
               5.0f);
    const float filled = half * mark.suspicion;
    canvas.arc(center, side_radius, bearing - filled, bearing + filled, color, 5.0f);
    const glm::vec2 out = towards(bearing), across(-out.y, out.x);
    const glm::vec2 tip = center + canvas.px(side_radius + 25.0f) * out;
    const glm::vec2 base = center + canvas.px(side_radius + 7.0f) * out;
    const glm::vec2 corners[] = {tip, base + canvas.px(5.5f) * across,
                                 base - canvas.px(5.5f) * across};
    canvas.polygon(corners, color);
}

// A triangle over the drone that fills with its suspicion; alarmed it is full and bears a mark.
void draw_drone_mark(const Canvas& canvas, const DroneMark& mark) {
    const glm::vec2 tip = mark.sight.place - glm::vec2(0.0f, mark.radius + canvas.px(10.0f));
    const float high = canvas.px(22.0f), wide = canvas.px(13.0f);
    const Color color = theme::danger(mark.alarmed ? 1.0f : mark.suspicion);
    const auto triangle = [&](float part, const Color& fill) {
        const glm::vec2 corners[] = {tip, tip + part * glm::vec2(-wide, -high),
                                     tip + part * glm::vec2(wide, -high)};
        canvas.polygon(corners, fill);
    };
    triangle(1.0f, {0.0f, 0.0f, 0.0f, 0.55f});
    triangle(mark.alarmed ? 1.0f : mark.suspicion, color);
    const glm::vec2 outline[] = {tip, tip + glm::vec2(-wide, -high), tip + glm::vec2(wide, -high)};
    canvas.polyline(outline, color, 1.75f, true);
    if (mark.alarmed) {
        const glm::vec2 center = tip - glm::vec2(0.0f, 0.64f * high);
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

void draw_goal(const Canvas& canvas, const GoalMark& goal) {
    glm::vec2 place = goal.sight.place;
    if (!goal.sight.in_view) {
        const glm::vec2 out = towards(goal.sight.bearing);
        place = 0.5f * canvas.size() + canvas.px(side_radius + 34.0f) * out;
    }
    canvas.glow(place, 26.0f, theme::faded(theme::core, 0.4f));
    draw_diamond(canvas, place, 9.0f, theme::core, true);
    const auto metres = static_cast<int>(std::lround(goal.sight.distance));
    canvas.text(place + glm::vec2(0.0f, canvas.px(13.0f)), Face::small, theme::text,
                goal.label + "  " + std::to_string(metres) + " m", Align::center);
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

void show_marks(const Canvas& canvas, const Hud& hud) {
    for (const GoalMark& goal : hud.goals) draw_goal(canvas, goal);
    for (const DroneMark& mark : hud.drone_marks) {
        if (mark.suspicion <= 0.0f && !mark.alarmed) continue;
        if (mark.sight.in_view)
            draw_drone_mark(canvas, mark);
        else
            draw_side_mark(canvas, mark);
    }
}

} // namespace host::ui
