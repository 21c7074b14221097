#include "sparks.h"

#include <cmath>
#include <cstddef>

#include "../effects/scatter.h"

namespace host::game {

namespace {

using three_cores::Sound;

constexpr double gravity = 9.81;

struct Kind {
    Sound cause;
    uint32_t count;
    double life, speed; // seconds, metres a second
    float radius;       // metres
    glm::vec3 color;    // at first
    float flash;        // metres: a disc that shines for a moment; 0: none
};
constexpr Kind kinds[] = {{Sound::blast, 220, 1.1, 9.0, 0.035f, {9.0f, 4.2f, 1.3f}, 1.6f},
                          {Sound::disabled, 90, 1.3, 4.0, 0.022f, {3.0f, 5.0f, 8.0f}, 0.5f},
                          {Sound::shot, 14, 0.25, 3.0, 0.02f, {8.0f, 2.2f, 0.8f}, 0.35f},
                          {Sound::bounce, 10, 0.35, 1.6, 0.008f, {4.0f, 2.2f, 0.9f}, 0.0f},
                          {Sound::core, 120, 1.2, 2.2, 0.02f, {1.2f, 5.0f, 6.5f}, 0.7f}};
constexpr double flash_life = 0.14; // seconds

const Kind* find_kind(Sound cause) {
    for (const Kind& kind : kinds)
        if (kind.cause == cause) return &kind;
    return nullptr;
}

rt_particle particle_of(const glm::dvec3& place, float radius, const glm::vec3& color) {
    return {{place.x, place.y, place.z}, radius, {color.x, color.y, color.z}};
}

// Where air stops it: v (1 - exp(-k t)) / k.
double way_after(double speed, double seconds) {
    constexpr double drag = 2.2; // per second
    return speed * (1.0 - std::exp(-drag * seconds)) / drag;
}

void add_spark(const Kind& kind, const glm::dvec3& point, uint32_t number, double age,
               std::vector<rt_particle>& particles) {
    const double life = kind.life * (0.4 + 0.6 * scatter(number, 20));
    if (age >= life) return;
    const double height = 2.0 * scatter(number, 21) - 0.7;
    const double turn = 6.2831853 * scatter(number, 22);
    const double flat = std::sqrt(std::max(0.05, 1.0 - height * height));
    const double way = way_after(kind.speed * (0.25 + 0.75 * scatter(number, 23)), age);
    const glm::dvec3 offset(way * flat * std::cos(turn), way * height - 0.35 * gravity * age * age,
                            way * flat * std::sin(turn));
    const auto left = static_cast<float>(1.0 - age / life);
    const glm::vec3 cooled(left, left * left, left * left * left);
    const float size = kind.radius * (0.4f + 0.6f * left);
    particles.push_back(particle_of(point + offset, size, kind.color * cooled));
}

} // namespace

void Sparks::add(std::span<const three_cores::Event> events, double seconds) {
    for (const three_cores::Event& event : events)
        if (find_kind(event.sound))
            bursts_.push_back({event.sound, event.point, seconds, count_++});
}

void Sparks::add_particles(double seconds, std::vector<rt_particle>& particles) {
    std::erase_if(bursts_, [&](const Burst& burst) {
        return seconds - burst.seconds > find_kind(burst.cause)->life;
    });
    for (const Burst& burst : bursts_) {
        const Kind& kind = *find_kind(burst.cause);
        const double age = seconds - burst.seconds;
        if (kind.flash > 0.0f && age < flash_life) {
            const auto left = static_cast<float>(1.0 - age / flash_life);
            particles.push_back(
                particle_of(burst.point, kind.flash * (1.2f - 0.4f * left), kind.color * left));
        }
        for (uint32_t i = 0; i < kind.count; ++i)
            add_spark(kind, burst.point, burst.number * 4099u + i, age, particles);
    }
}

void add_glints(const three_cores::Game& game, std::vector<rt_particle>& particles) {
    const double seconds = static_cast<double>(game.ticks()) * three_cores::kTick;
    for (const three_cores::Core& core : game.cores()) {
        if (core.taken) continue;
        particles.push_back(particle_of(core.position, 0.55f, {0.05f, 0.35f, 0.5f}));
        for (uint32_t i = 0; i < 16; ++i) { // motes that circle it
            const double turn = seconds * (0.6 + 0.8 * scatter(i, 24)) + 6.2831853 * scatter(i, 25);
            const double far = 0.3 + 0.25 * scatter(i, 26);
            const glm::dvec3 offset(far * std::cos(turn), 0.35 * std::sin(0.7 * turn + i),
                                    far * std::sin(turn));
            particles.push_back(particle_of(core.position + offset, 0.014f, {0.8f, 3.2f, 4.0f}));
        }
    }
    for (const three_cores::Bolt& bolt : game.bolts()) {
        const glm::dvec3 place = bolt.flight.position();
        const glm::dvec3 step = 0.02 * bolt.flight.velocity();
        particles.push_back(particle_of(place, 0.3f, {2.2f, 0.4f, 0.12f}));
        for (int i = 1; i < 8; ++i)
            particles.push_back(
                particle_of(place - (0.25 * i) * step, 0.12f - 0.012f * float(i),
                            glm::vec3(1.6f, 0.25f, 0.06f) * (1.0f - 0.12f * float(i))));
    }
    for (const three_cores::Drone& drone : game.drones()) {
        if (drone.is_disabled()) continue;
        const float pulse =
            0.8f + 0.2f * static_cast<float>(std::sin(23.0 * seconds + drone.position().x));
        particles.push_back(particle_of(drone.position() - glm::dvec3(0, 0.24, 0), 0.2f,
                                        glm::vec3(0.9f, 0.32f, 0.08f) * pulse));
    }
}

} // namespace host::game
