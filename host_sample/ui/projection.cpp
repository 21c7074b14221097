#include "ui/projection.h"

#include <algorithm>
#include <cmath>

namespace host::ui {

namespace {

constexpr float nearest = 0.05f; // metres before the eye
constexpr int ring_corners = 40;
constexpr float storey = 2.2f;          // metres
constexpr float behind_bearing = 1.75f; // radians: 100 degrees

bool is_steep(const Sight& sight) {
    return std::abs(sight.rise) > 0.7f * sight.distance;
}

bool is_behind(const Sight& sight) {
    return !is_steep(sight) && std::abs(sight.bearing) > behind_bearing;
}

} // namespace

Projection::Projection(const Viewpoint& view, int width, int height)
    : eye_(view.position), forward_(glm::normalize(view.forward)),
      center_(0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height)),
      focal_(center_.y / std::tan(0.5f * view.vertical_fov)) {
    const bool steep = glm::length(glm::cross(forward_, view.up)) < 1e-4f;
    const glm::vec3 up = steep ? glm::vec3(forward_.y, forward_.z, forward_.x) : view.up;
    right_ = glm::normalize(glm::cross(forward_, up));
    up_ = glm::cross(right_, forward_);
}

glm::vec3 Projection::in_view_space(const glm::dvec3& point) const {
    const glm::vec3 way(point - eye_);
    return {glm::dot(way, right_), glm::dot(way, up_), glm::dot(way, forward_)};
}

std::optional<glm::vec2> Projection::place(const glm::dvec3& point) const {
    const glm::vec3 seen = in_view_space(point);
    if (seen.z < nearest) return {};
    return center_ + focal_ / seen.z * glm::vec2(seen.x, -seen.y);
}

// What is behind is reached by a turn, and shown as on a compass; what is straight behind lies at
// the bottom. All else is where it would come into view.
glm::vec2 Projection::way_out(const glm::vec3& seen, const Sight& sight) const {
    if (is_behind(sight)) return {std::sin(sight.bearing), -std::cos(sight.bearing)};
    const glm::vec2 way(seen.x, -seen.y);
    const float length = glm::length(way);
    return length > 1e-6f ? way / length : glm::vec2(0.0f, 1.0f);
}

Sight Projection::sight(const glm::dvec3& point) const {
    // A level bearing: who looks down at their feet still wants to know left from right.
    const glm::vec3 way(point - eye_);
    const glm::vec2 ahead = std::abs(forward_.y) < 0.99f ? glm::vec2(forward_.x, forward_.z)
                                                         : glm::vec2(right_.z, -right_.x);
    Sight sight;
    sight.bearing = std::atan2(glm::dot(glm::vec2(way.x, way.z), glm::vec2(right_.x, right_.z)),
                               glm::dot(glm::vec2(way.x, way.z), glm::normalize(ahead)));
    sight.distance = glm::length(way);
    sight.rise = way.y;
    if (const auto found = place(point)) {
        sight.place = *found;
        sight.in_view = found->x >= 0.0f && found->x < 2.0f * center_.x && found->y >= 0.0f
                        && found->y < 2.0f * center_.y;
    }
    if (!sight.in_view) sight.out = way_out(in_view_space(point), sight);
    return sight;
}

std::string whereabouts(const Sight& sight) {
    if (sight.in_view) return {};
    std::string words;
    if (std::abs(sight.rise) > storey || is_steep(sight))
        words = sight.rise > 0.0f ? "above" : "below";
    if (!is_behind(sight)) return words;
    return words.empty() ? "behind" : words + ", behind";
}

float Projection::radius(const glm::dvec3& middle, double metres) const {
    const float depth = in_view_space(middle).z;
    return depth < nearest ? 0.0f : focal_ * static_cast<float>(metres) / depth;
}

Arc project_arc(const Projection& projection, std::span<const glm::dvec3> points, double radius) {
    Arc arc;
    bool broken = true;
    for (const glm::dvec3& point : points) {
        const auto place = projection.place(point);
        if (place) {
            if (broken) arc.runs.emplace_back();
            arc.runs.back().push_back(*place);
        }
        broken = !place;
    }
    if (points.empty()) return arc;
    arc.end = projection.place(points.back());
    for (int i = 0; i < ring_corners; ++i) {
        const double angle = 6.283185307179586 * i / ring_corners;
        const glm::dvec3 way(radius * std::cos(angle), 0.0, radius * std::sin(angle));
        const auto place = projection.place(points.back() + way);
        if (!place) {
            arc.ring.clear();
            break;
        }
        arc.ring.push_back(*place);
    }
    return arc;
}

} // namespace host::ui
