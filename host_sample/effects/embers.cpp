#include "embers.h"

#include <algorithm>
#include <cmath>

#include "scatter.h"

namespace host {

namespace {

constexpr double life = 2.5;   // seconds
constexpr double speed = 0.9;  // metres a second, upward
constexpr double spread = 0.5; // metres, to the sides at the end
constexpr float radius = 0.014f;
constexpr float brightness = 14.0f;

} // namespace

rt_particle make_ember(const Light& lamp, uint32_t number, double seconds) {
    const double age = std::fmod(seconds + life * scatter(number, 0), life);
    const double part = age / life;
    const double turn = 6.2831853 * scatter(number, 1) + 3.0 * part;
    const double out = 0.08 + spread * part * scatter(number, 2);
    const glm::dvec3 offset(out * std::cos(turn), speed * age * (0.5 + scatter(number, 3)),
                            out * std::sin(turn));
    const glm::dvec3 place = lamp.position + offset;
    const float most = std::max({lamp.intensity.x, lamp.intensity.y, lamp.intensity.z, 1e-6f});
    const glm::vec3 hot = lamp.intensity / most * glm::vec3(1.0f, 0.75f, 0.45f);
    const auto left = static_cast<float>((1.0 - part) * std::min(part * 8.0, 1.0));
    const glm::vec3 color = hot * (brightness * left);
    const auto size = static_cast<float>(0.5 + scatter(number, 4));
    return {{place.x, place.y, place.z}, radius * size, {color.x, color.y, color.z}};
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
