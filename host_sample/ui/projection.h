#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "level.h"

namespace host::ui {

// Where a point of the level is, for somebody who looks at the window.
struct Sight {
    glm::vec2 place{0.0f}; // pixels; only if in_view
    bool in_view = false;
    glm::vec2 out{0.0f};   // unit, on the window: which way to turn; only if not in_view
    float bearing = 0.0f;  // radians; 0: ahead, positive: to the right
    float distance = 0.0f; // metres
    float rise = 0.0f;     // metres above the eye
};

// "above", "below", "behind", two of them ("below, behind") or nothing: where to look for what is
// not in view. A storey higher or lower counts, and what is steep above or below the eye.
std::string whereabouts(const Sight& sight);

// From the level to the window's pixels, as the engine's pinhole camera sees it.
class Projection {
public:
    Projection(const Viewpoint& view, int width, int height);

    // Nothing for what is behind the eye or too near to it.
    std::optional<glm::vec2> place(const glm::dvec3& point) const;
    Sight sight(const glm::dvec3& point) const;
    // Pixels, of a ball in the middle of the view.
    float radius(const glm::dvec3& middle, double metres) const;

private:
    glm::vec3 in_view_space(const glm::dvec3& point) const; // right, up, forward
    glm::vec2 way_out(const glm::vec3& seen, const Sight& sight) const;

    glm::dvec3 eye_;
    glm::vec3 right_, up_, forward_;
    glm::vec2 center_;
    float focal_ = 1.0f; // pixels
};

// The way that a grenade would take, on the window.
struct Arc {
    std::vector<std::vector<glm::vec2>> runs; // parts of it that are before the eye
    std::vector<glm::vec2> ring;              // around where it ends; empty: not in view
    std::optional<glm::vec2> end;
};

// `points` as three_cores::Game::preview gives them; `radius` of the ring in metres, drawn level
// at the last point.
Arc project_arc(const Projection& projection, std::span<const glm::dvec3> points, double radius);

} // namespace host::ui
