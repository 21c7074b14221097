#include "actors.h"

#include <cmath>

#include <glm/ext/matrix_transform.hpp>

namespace host::game {

namespace {

using three_cores::Drone;
using three_cores::Game;

constexpr double blast_ticks = 24;
constexpr float blast_candela = 420.0f, beam_candela = 75.0f, core_candela = 3.0f;
constexpr double beam_reach = 14, core_reach = 4, blast_reach = 16;
constexpr double lens = 0.3; // metres before the middle of a drone: outside of its hull

// At a place, with -Z along a direction.
glm::dmat4 looking_along(const glm::dvec3& place, const glm::dvec3& direction) {
    const double length = glm::length(direction);
    const glm::dvec3 z = length > 0.0 ? -direction / length : glm::dvec3(0, 0, 1);
    const glm::dvec3 up = std::abs(z.y) < 0.999 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(up, z));
    return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0),
            glm::dvec4(place, 1)};
}

rt_light_desc point_lamp(const glm::dvec3& place, const glm::vec3& color, double reach) {
    rt_light_desc lamp = rt_default_light_desc();
    lamp.type = RT_LIGHT_POINT;
    lamp.radius = static_cast<float>(reach);
    for (int k = 0; k < 3; ++k) {
        lamp.position[k] = place[k];
        lamp.intensity[k] = color[k];
    }
    return lamp;
}

glm::vec3 mood_color(gameplay::Mood mood) {
    switch (mood) {
    case gameplay::Mood::calm:
        return {0.85f, 0.93f, 1.0f};
    case gameplay::Mood::suspicious:
        return {1.0f, 0.62f, 0.16f};
    case gameplay::Mood::alarmed:
        break;
    }
    return {1.0f, 0.13f, 0.08f};
}

// What the drone can see by is what can be seen of its view.
rt_light_desc beam_of(const Drone& drone, double cos_half_angle) {
    const glm::dvec3 forward = glm::normalize(drone.forward());
    rt_light_desc lamp = point_lamp(drone.position() + lens * forward,
                                    beam_candela * mood_color(drone.mood()), beam_reach);
    lamp.type = RT_LIGHT_SPOT;
    for (int k = 0; k < 3; ++k) lamp.direction[k] = static_cast<float>(forward[k]);
    lamp.cone_outer_cos = static_cast<float>(cos_half_angle);
    lamp.cone_inner_cos = 0.5f * (1.0f + lamp.cone_outer_cos);
    return lamp;
}

} // namespace

Actors::Actors(Stage& stage, const Props& props)
    : drones_(stage, props.drone), drones_off_(stage, props.drone_off), cores_(stage, props.core),
      grenades_(stage, props.grenade), bolts_(stage, props.bolt), lamps_(stage) {}

void Actors::show(const Game& game) {
    lit_.clear();
    show_drones(game);
    show_cores(game);
    show_blasts(game);
    std::vector<glm::dmat4> places;
    for (const three_cores::Thrown& thrown : game.thrown())
        places.push_back(glm::translate(glm::dmat4(1.0), thrown.ball.position()));
    grenades_.show(places);
    places.clear();
    for (const three_cores::Bolt& bolt : game.bolts())
        places.push_back(looking_along(bolt.flight.position(), bolt.flight.velocity()));
    bolts_.show(places);
    lamps_.show(lit_);
}

void Actors::show_drones(const Game& game) {
    std::vector<glm::dmat4> working, off;
    for (const Drone& drone : game.drones()) {
        const bool works = !drone.is_disabled();
        (works ? working : off).push_back(looking_along(drone.position(), drone.forward()));
        if (works) lit_.push_back(beam_of(drone, game.rules().sentry.cos_half_angle));
    }
    drones_.show(working);
    drones_off_.show(off);
}

void Actors::show_cores(const Game& game) {
    const double seconds = static_cast<double>(game.ticks()) * three_cores::kTick;
    std::vector<glm::dmat4> places;
    for (const three_cores::Core& core : game.cores()) {
        if (core.taken) continue;
        const glm::dvec3 place =
            core.position + glm::dvec3(0, 0.06 * std::sin(2.0 * seconds + core.position.x), 0);
        places.push_back(glm::rotate(glm::translate(glm::dmat4(1.0), place), 0.9 * seconds,
                                     glm::dvec3(0, 1, 0)));
        lit_.push_back(point_lamp(place, core_candela * glm::vec3(0.35f, 0.8f, 1.0f), core_reach));
        lit_.back().casts_no_shadow = 1; // it is inside the core
    }
    cores_.show(places);
}

void Actors::note(std::span<const three_cores::Event> events) {
    for (const three_cores::Event& event : events)
        if (event.sound == three_cores::Sound::blast)
            blasts_.push_back({event.point + glm::dvec3(0, 0.3, 0), 0});
}

void Actors::show_blasts(const Game& game) {
    const auto passed = static_cast<double>(game.ticks() - last_tick_);
    last_tick_ = game.ticks();
    for (Blast& blast : blasts_) {
        const double left = 1.0 - blast.age / blast_ticks;
        const auto strength = static_cast<float>(left * left) * blast_candela;
        lit_.push_back(
            point_lamp(blast.point, strength * glm::vec3(1.0f, 0.72f, 0.4f), blast_reach));
        blast.age += passed;
    }
    std::erase_if(blasts_, [](const Blast& blast) { return blast.age >= blast_ticks; });
}

void Actors::hide() {
    for (PropPool* pool : {&drones_, &drones_off_, &cores_, &grenades_, &bolts_}) pool->show({});
    lamps_.show({});
    blasts_.clear();
    last_tick_ = 0;
}

} // namespace host::game
