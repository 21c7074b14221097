#include "flight.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

namespace host {

namespace {

glm::dquat to_orientation(const Viewpoint& view) {
    const glm::dvec3 back = -glm::normalize(glm::dvec3(view.forward));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(view.up), back));
    return glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back));
}

glm::dvec3 catmull_rom(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                       const glm::dvec3& d, double t) {
    return 0.5
           * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * (t * t)
              + (3.0 * (b - c) + d - a) * (t * t * t));
}

} // namespace

Flight::Flight(std::vector<Viewpoint> stops, const glm::dvec3& center, bool orbits)
    : stops_(std::move(stops)), center_(center), orbits_(orbits) {}

Viewpoint Flight::at(double fraction) const {
    if (stops_.size() == 1) {
        Viewpoint view = stops_.front();
        const glm::dquat turn =
            glm::angleAxis(fraction * glm::two_pi<double>(), glm::dvec3(0.0, 1.0, 0.0));
        if (orbits_) view.position = center_ + turn * (view.position - center_);
        view.forward = glm::vec3(turn * glm::dvec3(view.forward));
        view.up = glm::vec3(turn * glm::dvec3(view.up));
        return view;
    }
    const auto last = static_cast<double>(stops_.size() - 1);
    const double along = std::clamp(fraction, 0.0, 1.0) * last;
    const auto i = static_cast<size_t>(std::min(std::floor(along), last - 1.0));
    const double t = along - static_cast<double>(i);
    const auto stop = [&](size_t k) -> const Viewpoint& {
        return stops_[std::min(k, stops_.size() - 1)];
    };
    Viewpoint view = stop(i);
    view.position = catmull_rom(stop(i > 0 ? i - 1 : 0).position, stop(i).position,
                                stop(i + 1).position, stop(i + 2).position, t);
    const glm::dquat orientation =
        glm::slerp(to_orientation(stop(i)), to_orientation(stop(i + 1)), t);
    view.forward = glm::vec3(orientation * glm::dvec3(0.0, 0.0, -1.0));
    view.up = glm::vec3(orientation * glm::dvec3(0.0, 1.0, 0.0));
    view.vertical_fov =
        glm::mix(stop(i).vertical_fov, stop(i + 1).vertical_fov, static_cast<float>(t));
    return view;
}

} // namespace host
