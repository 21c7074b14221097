#include "backdrop.h"

#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

namespace host::game {

namespace {

constexpr double shot = 16;  // seconds
constexpr double sway = 0.1; // radians to either side

} // namespace

Viewpoint backdrop(std::span<const Viewpoint> cameras, double seconds) {
    const double shots = seconds / shot;
    Viewpoint view = cameras[static_cast<size_t>(shots) % cameras.size()];
    const double angle = sway * std::sin((shots - std::floor(shots) - 0.5) * glm::pi<double>());
    view.forward = glm::vec3(glm::angleAxis(angle, glm::normalize(glm::dvec3(view.up)))
                             * glm::dvec3(view.forward));
    return view;
}

} // namespace host::game
