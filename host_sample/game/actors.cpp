#include "actors.h"

#include <cmath>

#include <glm/ext/matrix_transform.hpp>

namespace host::game {

namespace {

using three_cores::Drone;
using three_cores::Game;

// At a place, with -Z along a direction.
glm::dmat4 looking_along(const glm::dvec3& place, const glm::dvec3& direction) {
    const double length = glm::length(direction);
    const glm::dvec3 z = length > 0.0 ? -direction / length : glm::dvec3(0, 0, 1);
    const glm::dvec3 up = std::abs(z.y) < 0.999 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(up, z));
    return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0),
            glm::dvec4(place, 1)};
}

double seconds_of(const Game& game) {
    return static_cast<double>(game.ticks()) * three_cores::kTick;
}

rt_light_desc light_of(const three_cores::Glow& glow) {
    const three_cores::Lamp& lamp = glow.lamp;
    rt_light_desc light = rt_default_light_desc();
    light.type = lamp.kind == three_cores::Lamp::Kind::spot ? RT_LIGHT_SPOT : RT_LIGHT_POINT;
    light.radius = static_cast<float>(lamp.radius);
    for (int k = 0; k < 3; ++k) {
        light.position[k] = lamp.position[k];
        light.direction[k] = static_cast<float>(lamp.direction[k]);
        light.intensity[k] = static_cast<float>(glow.color[k]);
    }
    light.cone_outer_cos = static_cast<float>(lamp.cos_outer);
    light.cone_inner_cos = static_cast<float>(lamp.cos_inner);
    light.casts_no_shadow = glow.casts_shadow ? 0 : 1;
    light.fog_scatter = 0.8f; // beams of drones are seen in mist
    return light;
}

} // namespace

Actors::Actors(Stage& stage, const Props& props, LevelEffects& effects)
    : drones_(stage, props.drone), drones_off_(stage, props.drone_off), cores_(stage, props.core),
      grenades_(stage, props.grenade), bolts_(stage, props.bolt), lamps_(stage), effects_(effects) {
}

void Actors::show(const Game& game) {
    show_drones(game);
    show_cores(game);
    std::vector<glm::dmat4> places;
    for (const three_cores::Thrown& thrown : game.thrown())
        places.push_back(glm::translate(glm::dmat4(1.0), thrown.ball.position()));
    grenades_.show(places);
    places.clear();
    for (const three_cores::Bolt& bolt : game.bolts())
        places.push_back(looking_along(bolt.flight.position(), bolt.flight.velocity()));
    bolts_.show(places);
    lit_.clear();
    for (const three_cores::Glow& glow : game.glows()) lit_.push_back(light_of(glow));
    lamps_.show(lit_);
    if (has_effects_)
        effects_.describe(seconds_of(game), game.eye().position);
    else
        effects_.hide_mist();
}

void Actors::add_particles(const Game& game, std::span<const three_cores::Event> events,
                           std::vector<rt_particle>& particles) {
    const double seconds = seconds_of(game);
    sparks_.add(events, seconds);
    if (!has_effects_) return;
    effects_.add_particles(seconds, particles);
    sparks_.add_particles(seconds, particles);
    add_glints(game, particles);
}

void Actors::show_drones(const Game& game) {
    std::vector<glm::dmat4> working, off;
    for (const Drone& drone : game.drones()) {
        auto& places = drone.is_disabled() ? off : working;
        places.push_back(looking_along(drone.position(), drone.forward()));
    }
    drones_.show(working);
    drones_off_.show(off);
}

void Actors::show_cores(const Game& game) {
    const double seconds = seconds_of(game);
    std::vector<glm::dmat4> places;
    for (const three_cores::Core& core : game.cores()) {
        if (core.taken) continue;
        const glm::dvec3 place =
            core.position + glm::dvec3(0, 0.06 * std::sin(2.0 * seconds + core.position.x), 0);
        places.push_back(glm::rotate(glm::translate(glm::dmat4(1.0), place), 0.9 * seconds,
                                     glm::dvec3(0, 1, 0)));
    }
    cores_.show(places);
}

void Actors::hide() {
    for (PropPool* pool : {&drones_, &drones_off_, &cores_, &grenades_, &bolts_}) pool->show({});
    lamps_.show({});
    sparks_ = {};
}

} // namespace host::game
