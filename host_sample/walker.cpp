#include "walker.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace host {

namespace {

constexpr double walk_speed = 3.5, fly_speed = 5.0, run_factor = 2.5; // metres a second
constexpr double eye_height = 1.65, step_height = 0.5, body_radius = 0.3;
constexpr double gravity = 9.81, fastest_fall = 40.0;
constexpr double farthest_floor = 200.0; // below it there is nothing to fall onto
constexpr double steepest_look = 1.55;
constexpr double climb_speed = 4.0; // how fast the eye follows a stair

} // namespace

void Walker::place(const Viewpoint& viewpoint) {
    const glm::dvec3 f = glm::normalize(glm::dvec3(viewpoint.forward));
    eye_ = viewpoint.position;
    pitch_ = std::clamp(std::asin(std::clamp(f.y, -1.0, 1.0)), -steepest_look, steepest_look);
    // Looking straight down, the heading is where the top of the picture points.
    const glm::dvec3 heading =
        std::hypot(f.x, f.z) > 1e-3 ? f : glm::dvec3(viewpoint.up) * (f.y > 0.0 ? -1.0 : 1.0);
    yaw_ = std::atan2(-heading.x, -heading.z);
    vertical_fov_ = viewpoint.vertical_fov;
    fall_speed_ = 0.0;
}

void Walker::toggle_walking() {
    walking_ = !walking_;
    fall_speed_ = 0.0;
}

glm::dvec3 Walker::forward() const {
    const double c = std::cos(pitch_);
    return {-std::sin(yaw_) * c, std::sin(pitch_), -std::cos(yaw_) * c};
}

Viewpoint Walker::viewpoint() const {
    Viewpoint view;
    view.position = eye_;
    view.forward = glm::vec3(forward());
    view.vertical_fov = vertical_fov_;
    return view;
}

void Walker::step(const Controls& controls, double seconds) {
    const glm::dvec2 turn = glm::dvec2(controls.turn) + glm::dvec2(controls.turn_rate) * seconds;
    yaw_ = std::remainder(yaw_ + turn.x, glm::two_pi<double>());
    pitch_ = std::clamp(pitch_ + turn.y, -steepest_look, steepest_look);
    if (walking_)
        walk(controls, seconds);
    else
        fly(controls, seconds);
}

void Walker::fly(const Controls& controls, double seconds) {
    const glm::dvec3 right(std::cos(yaw_), 0.0, -std::sin(yaw_));
    const double speed = fly_speed * (controls.run ? run_factor : 1.0);
    eye_ += (forward() * static_cast<double>(controls.forward)
             + right * static_cast<double>(controls.right)
             + glm::dvec3(0.0, static_cast<double>(controls.up), 0.0))
            * (speed * seconds);
}

void Walker::walk(const Controls& controls, double seconds) {
    const glm::dvec3 ahead(-std::sin(yaw_), 0.0, -std::cos(yaw_));
    const glm::dvec3 right(std::cos(yaw_), 0.0, -std::sin(yaw_));
    glm::dvec3 wish =
        ahead * static_cast<double>(controls.forward) + right * static_cast<double>(controls.right);
    const double length = glm::length(wish);
    if (length > 1.0) wish /= length; // diagonals are no faster
    const double speed = walk_speed * (controls.run ? run_factor : 1.0);
    eye_ += slide_along_walls(wish * (speed * seconds));
    settle_on_floor(seconds);
}

// Rays ahead at three heights, from the middle and both shoulders: what they meet takes away the
// part of the motion that leads into it. A second round keeps the body out of corners.
glm::dvec3 Walker::slide_along_walls(glm::dvec3 motion) const {
    for (int round = 0; round < 3; ++round) {
        const double length = glm::length(motion);
        if (length < 1e-6) return glm::dvec3(0.0);
        const glm::dvec3 direction = motion / length;
        const glm::dvec3 side(direction.z, 0.0, -direction.x);
        std::optional<Contact> nearest;
        for (const double drop : {eye_height - step_height, 0.5 * eye_height, 0.0})
            for (const double offset : {0.0, -0.7 * body_radius, 0.7 * body_radius}) {
                const glm::dvec3 origin = eye_ - glm::dvec3(0.0, drop, 0.0) + side * offset;
                const auto contact = probe_.cast(origin, direction, length + body_radius);
                if (contact && (!nearest || contact->distance < nearest->distance))
                    nearest = contact;
            }
        if (!nearest) return motion;
        glm::dvec3 wall(nearest->normal.x, 0.0, nearest->normal.z);
        const double steepness = glm::length(wall);
        if (steepness < 0.7) return motion; // a ramp: the floor rays climb it
        wall /= steepness;
        motion -= wall * std::min(glm::dot(motion, wall), 0.0);
    }
    return glm::dvec3(0.0);
}

void Walker::settle_on_floor(double seconds) {
    double height = farthest_floor; // of the eye above the highest floor under the body
    bool found = false;
    const double r = 0.7 * body_radius;
    for (const glm::dvec3& offset :
         {glm::dvec3(0.0), glm::dvec3(r, 0.0, 0.0), glm::dvec3(-r, 0.0, 0.0),
          glm::dvec3(0.0, 0.0, r), glm::dvec3(0.0, 0.0, -r)}) {
        const auto floor = probe_.cast(eye_ + offset, glm::dvec3(0.0, -1.0, 0.0), farthest_floor);
        // Nearer than a step is an edge beside the body, not a floor under it.
        if (!floor || floor->distance < eye_height - step_height - 0.3) continue;
        height = std::min(height, floor->distance);
        found = true;
    }
    if (!found) { // over the void: stay, rather than fall for ever
        fall_speed_ = 0.0;
        return;
    }
    const double above = height - eye_height;
    if (above <= 1e-3) {
        fall_speed_ = 0.0;
        eye_.y += std::min(-above, climb_speed * seconds);
        return;
    }
    const bool stair = fall_speed_ == 0.0 && above < step_height;
    fall_speed_ = std::min(fall_speed_ + gravity * seconds, fastest_fall);
    const double drop = stair ? climb_speed * seconds : fall_speed_ * seconds;
    if (drop >= above || stair) fall_speed_ = 0.0;
    eye_.y -= std::min(drop, above);
}

} // namespace host
