#include "fires.h"

#include <cmath>
#include <string_view>

#include "embers.h"
#include "scatter.h"

namespace host {

namespace {

constexpr double tongue_life = 0.7; // seconds
constexpr double below_lamp = 0.5;  // metres: where flames begin

struct Kind {
    std::string_view name;
    float size;
    uint32_t tongues, embers;
};
constexpr Kind kinds[] = {
    {"brazier_", 0.34f, 22, 36}, {"torchere_", 0.2f, 12, 14}, {"sconce_", 0.13f, 8, 0}};

// A soft disc that rises from the flame's foot and gets smaller and redder.
rt_particle make_tongue(const Fires::Fire& fire, uint32_t number, double seconds) {
    const double life = tongue_life * (0.7 + 0.6 * scatter(number, 5));
    const double beats = seconds / life + scatter(number, 6);
    const double part = beats - std::floor(beats);
    const uint32_t birth = number * 977u + static_cast<uint32_t>(static_cast<int64_t>(beats));
    const double size = static_cast<double>(fire.size);
    const double turn = 6.2831853 * scatter(birth, 7);
    const double out = size * 0.55 * std::sqrt(scatter(birth, 8)) * (1.0 - 0.8 * part);
    const double sway = 0.12 * size * std::sin(9.0 * seconds + 6.0 * part + turn);
    const glm::dvec3 place = fire.light.position
                             + glm::dvec3(out * std::cos(turn) + sway * part,
                                          2.2 * size * part - below_lamp, out * std::sin(turn));
    const auto left = static_cast<float>(std::min(part * 6.0, 1.0) * (1.0 - part));
    const glm::vec3 color = glm::mix(glm::vec3(1.0f, 0.36f, 0.07f), glm::vec3(1.0f, 0.14f, 0.01f),
                                     static_cast<float>(part))
                            * (0.95f * left);
    const auto radius = static_cast<float>(size * (0.5 - 0.35 * part));
    return {{place.x, place.y, place.z}, radius, {color.x, color.y, color.z}};
}

} // namespace

Fires::Fires(const Level& level) {
    for (uint32_t i = 0; i < level.lights.size(); ++i)
        for (const Kind& kind : kinds)
            if (level.lights[i].name.starts_with(kind.name))
                fires_.push_back({i, level.lights[i], kind.size, kind.tongues, kind.embers});
}

void Fires::add(double seconds, std::vector<rt_particle>& particles) const {
    uint32_t number = 0;
    for (const Fire& fire : fires_) {
        for (uint32_t i = 0; i < fire.tongues; ++i)
            particles.push_back(make_tongue(fire, number++, seconds));
        for (uint32_t i = 0; i < fire.embers; ++i)
            particles.push_back(make_ember(fire.light, number++, seconds));
    }
}

float flicker(const Fires::Fire& fire, double seconds) {
    const double phase = 6.2831853 * scatter(fire.lamp, 9);
    const double wave = std::sin(7.3 * seconds + phase) + 0.6 * std::sin(17.9 * seconds + 2 * phase)
                        + 0.4 * std::sin(31.7 * seconds + 3 * phase);
    return static_cast<float>(1.0 + 0.07 * wave);
}

} // namespace host
