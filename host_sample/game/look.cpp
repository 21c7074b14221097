#include "look.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace host::game {

namespace {

constexpr double steepest_look = 1.5;

} // namespace

void Look::face(const glm::dvec3& forward) {
    const glm::dvec3 f = glm::normalize(forward);
    pitch_ = std::clamp(std::asin(std::clamp(f.y, -1.0, 1.0)), -steepest_look, steepest_look);
    yaw_ = std::atan2(-f.x, -f.z);
}

void Look::turn(const glm::dvec2& radians) {
    yaw_ = std::remainder(yaw_ + radians.x, glm::two_pi<double>());
    pitch_ = std::clamp(pitch_ + radians.y, -steepest_look, steepest_look);
}

glm::vec3 Look::direction() const {
    const double c = std::cos(pitch_);
    return glm::vec3(-std::sin(yaw_) * c, std::sin(pitch_), -std::cos(yaw_) * c);
}

gameplay::TickInput Look::input(const glm::vec2& walk, uint32_t buttons) const {
    const glm::dvec2 ahead(-std::sin(yaw_), -std::cos(yaw_)),
        right(std::cos(yaw_), -std::sin(yaw_));
    glm::vec2 way(right * static_cast<double>(walk.x) + ahead * static_cast<double>(walk.y));
    // A length of 1 plus a rounding is as good as 1 to the player, but not to the game.
    while (glm::dot(way, way) > 1.0f) way *= 0.999999f / glm::length(way);
    gameplay::TickInput input;
    input.buttons = buttons;
    const glm::vec3 view = direction();
    for (int k = 0; k < 3; ++k) input.view[k] = view[k];
    input.walk[0] = way.x;
    input.walk[1] = way.y;
    return input;
}

} // namespace host::game
