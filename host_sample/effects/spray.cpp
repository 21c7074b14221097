#include "spray.h"

#include <cmath>

#include "scatter.h"

namespace host {

namespace {

constexpr uint32_t drops = 700; // of a place
constexpr double gravity = 9.81;
constexpr double up = 2.4, out = 0.95; // metres a second
constexpr double fall = 2.6;           // metres below the place: where they are gone

rt_particle make_drop(const glm::dvec3& source, uint32_t number, double seconds) {
    const double rise = up * (0.75 + 0.25 * scatter(number, 10));
    const double life = (rise + std::sqrt(rise * rise + 2.0 * gravity * fall)) / gravity;
    const double beats = seconds / life + scatter(number, 11);
    const double age = life * (beats - std::floor(beats));
    const uint32_t birth = number * 977u + static_cast<uint32_t>(static_cast<int64_t>(beats));
    const double turn =
        6.2831853 * (static_cast<double>(birth % 12) + 0.25 * scatter(birth, 12)) / 12;
    const double way = age * out * (0.8 + 0.3 * scatter(birth, 13));
    const glm::dvec3 place =
        source
        + glm::dvec3(way * std::cos(turn), rise * age - 0.5 * gravity * age * age,
                     way * std::sin(turn));
    const auto shine = static_cast<float>(0.25 + 0.75 * scatter(birth, 14));
    const glm::vec3 color = glm::vec3(0.55f, 0.66f, 0.8f) * (0.8f * shine);
    const auto radius = static_cast<float>(0.01 + 0.016 * scatter(birth, 15));
    return {{place.x, place.y, place.z}, radius, {color.x, color.y, color.z}};
}

} // namespace

void add_spray(const Level& level, double seconds, std::vector<rt_particle>& particles) {
    uint32_t number = 0;
    for (const Viewpoint& place : level.places) {
        if (!place.name.starts_with("spray_")) continue;
        for (uint32_t i = 0; i < drops; ++i)
            particles.push_back(make_drop(place.position, number++, seconds));
    }
}

} // namespace host
