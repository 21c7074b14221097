#include "cameras.h"

#include <charconv>
#include <cmath>

#include "error.h"

namespace host {

namespace {

std::optional<glm::vec3> unit_axis(const glm::dvec4& axis) {
    const glm::dvec3 v(axis);
    const double length = glm::length(v);
    if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
    return glm::vec3(v / length);
}

Viewpoint frame_bounds(const Bounds& bounds) {
    Viewpoint view;
    view.name = "bounds";
    const double radius = bounds.empty() ? 1.0 : std::max(0.5 * bounds.diagonal(), 1e-3);
    const glm::dvec3 towards = glm::normalize(glm::dvec3(-0.35, -0.35, -1.0));
    const double half_fov = 0.5 * static_cast<double>(view.vertical_fov);
    view.position = bounds.center() - towards * (0.9 * radius / std::sin(half_fov));
    view.forward = glm::vec3(towards);
    return view;
}

} // namespace

std::optional<Viewpoint> look_along(const glm::dmat4& world) {
    const auto forward = unit_axis(-world[2]);
    const auto up = unit_axis(world[1]);
    Viewpoint view;
    view.position = glm::dvec3(world[3]);
    const bool finite = std::isfinite(view.position.x + view.position.y + view.position.z);
    if (!forward || !up || !finite) return std::nullopt;
    if (glm::length(glm::cross(*forward, *up)) < 1e-3f) return std::nullopt;
    view.forward = *forward;
    view.up = *up;
    return view;
}

std::vector<Viewpoint> usable_cameras(const Level& level) {
    if (!level.cameras.empty()) return level.cameras;
    return {frame_bounds(level.bounds)};
}

size_t find_camera(const std::vector<Viewpoint>& cameras, const std::string& name_or_index) {
    if (name_or_index.empty()) return 0;
    for (size_t i = 0; i < cameras.size(); ++i)
        if (cameras[i].name == name_or_index) return i;
    size_t index = 0;
    const char* last = name_or_index.data() + name_or_index.size();
    const auto [end, error] = std::from_chars(name_or_index.data(), last, index);
    if (error == std::errc() && end == last && index < cameras.size()) return index;
    throw InputError("the scene has no camera \"" + name_or_index + "\"; it has "
                     + std::to_string(cameras.size()) + " (--list-cameras names them)");
}

Light default_light() {
    Light light;
    light.name = "default";
    light.type = LightType::directional;
    light.direction = glm::vec3(-0.35f, -0.8f, -0.55f);
    light.intensity = glm::vec3(2.5f);
    return light;
}

} // namespace host
