#include "mist.h"

#include <algorithm>
#include <cmath>

namespace host {

namespace {

constexpr float mist_density = 0.1f;             // per metre
constexpr double mist_depth = 1.4;               // metres: how thick its thinning top is
constexpr double near_enough = 8.0, gone = 16.0; // metres from the place
constexpr float mist_scatter = 0.5f;
constexpr glm::vec3 mist_color(0.085f, 0.105f, 0.14f);

void set(Stage& stage, float density, double bottom, double top, const glm::vec3& color) {
    rt_fog desc = rt_default_fog();
    desc.density = density;
    desc.bottom = bottom;
    desc.top = top;
    for (int k = 0; k < 3; ++k) desc.color[k] = color[k];
    stage.check(stage.api().set_fog(stage.scene(), &desc), "setting the fog");
}

} // namespace

void set_fog(Stage& stage, const Level& level, const Fog& fog, float ambient) {
    const double bottom = level.bounds.empty() ? 0.0 : level.bounds.lower.y;
    set(stage, fog.density, bottom, bottom + double(fog.top),
        2.0f * ambient * glm::vec3(0.9f, 0.95f, 1.1f));
}

void light_fog(Level& level, float part) {
    for (Light& light : level.lights)
        if (light.type != LightType::directional && std::isfinite(light.radius))
            light.fog_scatter = part;
}

void light_mist(Level& level) {
    for (Light& light : level.lights)
        for (const Viewpoint& place : level.places)
            if (place.name.starts_with("mist_") && std::isfinite(light.radius)
                && light.type != LightType::directional
                && glm::distance(light.position, place.position) < near_enough + 3.0)
                light.fog_scatter = mist_scatter;
}

void Mist::hide() {
    if (density_ > 0.0f) set(stage_, density_ = 0.0f, 0.0, 0.0, glm::vec3(0.0f));
}

bool Mist::show(const glm::dvec3& eye) {
    float density = 0.0f;
    double top = 0.0;
    for (const Viewpoint& place : level_.places) {
        if (!place.name.starts_with("mist_")) continue;
        const double away = std::hypot(eye.x - place.position.x, eye.z - place.position.z);
        const double part = std::clamp((gone - away) / (gone - near_enough), 0.0, 1.0);
        const auto here = mist_density * static_cast<float>(part * part * (3.0 - 2.0 * part));
        if (here <= density) continue;
        density = here;
        top = place.position.y;
    }
    if (density == density_) return false;
    set(stage_, density, top - mist_depth, top, mist_color);
    density_ = density;
    return true;
}

} // namespace host
