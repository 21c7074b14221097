#include "ui/goal_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <glm/glm.hpp>

namespace host::ui {

namespace {

// Units, as in theme.h.
constexpr float top_row = 132.0f, bottom_row = 178.0f, side = 34.0f; // kept free along the edges
constexpr float mark_radius = 11.0f, arrow = 16.0f, gap = 4.0f, inset = 8.0f;
constexpr int most_steps = 40, most_rows = 6;

Box around(glm::vec2 center, glm::vec2 half) {
    return {center - half, center + half};
}

// Where the way from the middle of the box leaves it.
glm::vec2 leave(const Box& box, glm::vec2 out) {
    const glm::vec2 center = 0.5f * (box.lower + box.upper), half = 0.5f * (box.upper - box.lower);
    const glm::vec2 steps = half / glm::max(glm::abs(out), glm::vec2(1e-6f));
    return glm::clamp(center + std::min(steps.x, steps.y) * out, box.lower, box.upper);
}

class Placer {
public:
    Placer(glm::vec2 window, float unit, std::vector<Box> taken)
        : window_{glm::vec2(inset * unit), window - glm::vec2(inset * unit)},
          edge_{glm::vec2(side, top_row) * unit, window - glm::vec2(side, bottom_row) * unit},
          unit_(unit), taken_(std::move(taken)) {}

    void take(const Box& box) { taken_.push_back(box); }
    Box mark_box(glm::vec2 place) const { return around(place, glm::vec2(mark_radius * unit_)); }

    GoalPlace in_view(glm::vec2 place, glm::vec2 size);
    GoalPlace at_edge(glm::vec2 out, glm::vec2 size);

private:
    bool is_free(const Box& box) const {
        return std::none_of(taken_.begin(), taken_.end(),
                            [&](const Box& other) { return box.overlaps(other); });
    }
    Box moved_inside(Box box) const;
    Box inwards(glm::vec2 mark, glm::vec2 out, glm::vec2 size) const;

    Box window_, edge_;
    float unit_;
    std::vector<Box> taken_;
};

Box Placer::moved_inside(Box box) const {
    const glm::vec2 by = glm::max(window_.lower - box.lower, glm::vec2(0.0f))
                         - glm::max(box.upper - window_.upper, glm::vec2(0.0f));
    return {box.lower + by, box.upper + by};
}

// Below its mark, above it, at its sides, or as near below or above as there is room.
GoalPlace Placer::in_view(glm::vec2 place, glm::vec2 size) {
    const glm::vec2 half = 0.5f * size;
    const float down = (mark_radius + gap) * unit_ + half.y,
                across = (mark_radius + gap) * unit_ + half.x;
    GoalPlace found{place, {}, {}};
    const auto fits = [&](glm::vec2 by) {
        found.label = moved_inside(around(place + by, half));
        return is_free(found.label);
    };
    const glm::vec2 first(0.0f, down);
    if (fits(first) || fits({0.0f, -down}) || fits({across, 0.0f}) || fits({-across, 0.0f}))
        return found;
    for (int i = 1; i < most_steps; ++i) {
        const float step = down + 0.5f * size.y * static_cast<float>(i);
        if (fits({0.0f, step}) || fits({0.0f, -step})) return found;
    }
    fits(first);
    return found;
}

// The text of a mark at the edge lies on the side of the window's middle.
Box Placer::inwards(glm::vec2 mark, glm::vec2 out, glm::vec2 size) const {
    const glm::vec2 half = 0.5f * size;
    const glm::vec2 away = glm::vec2((mark_radius + gap) * unit_) + half;
    const bool beside = mark.x <= edge_.lower.x + 1.0f || mark.x >= edge_.upper.x - 1.0f;
    const glm::vec2 by = beside ? glm::vec2(out.x > 0.0f ? -away.x : away.x, 0.0f)
                                : glm::vec2(0.0f, out.y > 0.0f ? -away.y : away.y);
    return moved_inside(around(mark + by, half));
}

// Along the edge to where there is room for mark and text, or else for the text further inside.
GoalPlace Placer::at_edge(glm::vec2 out, glm::vec2 size) {
    const glm::vec2 wanted = leave(edge_, out), step = 0.5f * size + glm::vec2(gap * unit_);
    const bool beside = wanted.x <= edge_.lower.x + 1.0f || wanted.x >= edge_.upper.x - 1.0f;
    const glm::vec2 along = beside ? glm::vec2(0.0f, step.y) : glm::vec2(step.x, 0.0f);
    const glm::vec2 in = beside ? glm::vec2(out.x > 0.0f ? -step.x : step.x, 0.0f)
                                : glm::vec2(0.0f, out.y > 0.0f ? -step.y : step.y);
    for (int row = 0; row < most_rows; ++row)
        for (int i = 0; i < most_steps; ++i) {
            const float way = static_cast<float>((i + 1) / 2) * (i % 2 == 0 ? 1.0f : -1.0f);
            const glm::vec2 mark = glm::clamp(wanted + way * along, edge_.lower, edge_.upper);
            const glm::vec2 by = static_cast<float>(row) * in;
            Box label = inwards(mark, out, size);
            label = moved_inside({label.lower + by, label.upper + by});
            const Box arrowed = around(mark, glm::vec2((mark_radius + arrow) * unit_));
            if (is_free(label) && is_free(arrowed)) return {mark, out, label};
        }
    return {wanted, out, inwards(wanted, out, size)};
}

} // namespace

std::string goal_text(const GoalMark& goal) {
    const std::string metres = std::to_string(std::lround(goal.sight.distance)) + " m";
    const std::string words = whereabouts(goal.sight);
    return goal.label + "  " + metres + (words.empty() ? "" : "  " + words);
}

std::vector<GoalPlace> place_goals(std::span<const GoalMark> goals,
                                   std::span<const glm::vec2> sizes, glm::vec2 window, float unit,
                                   std::vector<Box> taken) {
    std::vector<size_t> order(goals.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return goals[a].sight.distance < goals[b].sight.distance;
    });
    Placer placer(window, unit, std::move(taken));
    for (const GoalMark& goal : goals)
        if (goal.sight.in_view) placer.take(placer.mark_box(goal.sight.place));
    std::vector<GoalPlace> places(goals.size());
    for (const size_t i : order) {
        const Sight& sight = goals[i].sight;
        places[i] = sight.in_view ? placer.in_view(sight.place, sizes[i])
                                  : placer.at_edge(sight.out, sizes[i]);
        placer.take(places[i].label);
        if (!sight.in_view) placer.take(placer.mark_box(places[i].mark));
    }
    return places;
}

} // namespace host::ui
