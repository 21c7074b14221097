#include "air.h"

#include <algorithm>
#include <cmath>

#include "upload.h"

namespace host {

namespace {

constexpr double ember_life = 2.5;   // seconds
constexpr double ember_speed = 0.9;  // metres a second, upward
constexpr double ember_spread = 0.5; // metres, to the sides at the end
constexpr float ember_radius = 0.03f;
constexpr float ember_brightness = 14.0f;

// 0 to 1, another for each place of each ember.
double number_of(uint32_t ember, uint32_t place) {
    uint32_t bits = ember * 0x8da6b343u ^ place * 0xd8163841u ^ 0x2c1b3c6du;
    bits = (bits ^ bits >> 15) * 0x2c1b3c6du;
    bits = (bits ^ bits >> 13) * 0x85ebca6bu;
    return (bits >> 8) * 0x1p-24;
}

rt_particle make_ember(const Light& lamp, uint32_t number, double seconds) {
    const double age = std::fmod(seconds + ember_life * number_of(number, 0), ember_life);
    const double part = age / ember_life;
    const double turn = 6.2831853 * number_of(number, 1) + 3.0 * part;
    const double out = 0.08 + ember_spread * part * number_of(number, 2);
    const glm::dvec3 offset(out * std::cos(turn), ember_speed * age * (0.5 + number_of(number, 3)),
                            out * std::sin(turn));
    const glm::dvec3 place = lamp.position + offset;
    const float most = std::max({lamp.intensity.x, lamp.intensity.y, lamp.intensity.z, 1e-6f});
    const glm::vec3 hot = lamp.intensity / most * glm::vec3(1.0f, 0.75f, 0.45f);
    const auto left = static_cast<float>((1.0 - part) * std::min(part * 8.0, 1.0));
    const glm::vec3 color = hot * (ember_brightness * left);
    const auto size = static_cast<float>(0.5 + number_of(number, 4));
    return {{place.x, place.y, place.z}, ember_radius * size, {color.x, color.y, color.z}};
}

} // namespace

void set_fog(Stage& stage, const Level& level, const Fog& fog, float ambient) {
    rt_fog desc = rt_default_fog();
    desc.density = fog.density;
    desc.bottom = level.bounds.empty() ? 0.0 : level.bounds.lower.y;
    desc.top = desc.bottom + double(fog.top);
    const glm::vec3 color = 2.0f * ambient * glm::vec3(0.9f, 0.95f, 1.1f);
    for (int k = 0; k < 3; ++k) desc.color[k] = color[k];
    stage.check(stage.api().set_fog(stage.scene(), &desc), "setting the fog");
}

void light_fog(Level& level, float part) {
    for (Light& light : level.lights)
        if (light.type != LightType::directional && std::isfinite(light.radius))
            light.fog_scatter = part;
}

std::vector<rt_particle> make_embers(const Level& level, uint32_t count, double seconds) {
    std::vector<const Light*> lamps;
    for (const Light& light : level.lights)
        if (light.type == LightType::point) lamps.push_back(&light);
    std::vector<rt_particle> embers;
    if (lamps.empty()) return embers;
    embers.reserve(count);
    for (uint32_t i = 0; i < count; ++i)
        embers.push_back(make_ember(*lamps[i % lamps.size()], i, seconds));
    return embers;
}

} // namespace host
