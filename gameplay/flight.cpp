#include "gameplay/flight.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace peregrine::gameplay {
namespace {

constexpr double kLongestWindow = 1.0 / 32; // s
constexpr double kGrowth = 4, kCut = 8;
constexpr double kStraight = 1e-7;   // m, an arc this close to its chord is taken for it
constexpr double kRounding = 1.2e-7; // of a sweep's length: its direction and its t are floats

// One window of the arc: a parabola.
struct Arc {
    Vec3 velocity, acceleration;
    double duration;

    Vec3 at(double s) const { return s * (velocity + 0.5 * s * acceleration); }
    Vec3 velocity_at(double s) const { return velocity + s * acceleration; }
    // The arc is at most this far from the point of its chord at the same time; that is, from
    // there, in the direction against the acceleration.
    double rise() const { return 0.125 * duration * duration * glm::length(acceleration); }
};

// Drag as at the middle of the window.
Arc next_arc(const FlightRules& rules, const Flight& flight) {
    Vec3 acceleration = rules.gravity;
    if (rules.drag > 0) {
        const auto pull = [&](const Vec3& v) {
            return rules.gravity - rules.drag * glm::length(v) * v;
        };
        acceleration = pull(flight.velocity + 0.5 * flight.window * pull(flight.velocity));
    }
    return {flight.velocity, acceleration, flight.window};
}

void advance(const Arc& arc, double s, Flight& flight) {
    flight.position += arc.at(s);
    flight.velocity = arc.velocity_at(s);
    flight.time += s;
}

//     . - .         The sphere on the arc is within a capsule on the chord, which reaches from the
//   /       \       chord up to the arc's highest rise: above the real sphere, hardly beside or
//  (---------)      below it, so that floors and walls that it slides along are not met too early.
std::optional<Contact> sweep_around(const World& world, const FlightRules& rules, const Arc& arc,
                                    const Vec3& position) {
    const Vec3 chord = arc.at(arc.duration);
    const Vec3 half_rise = -0.0625 * arc.duration * arc.duration * arc.acceleration;
    const double radius = rules.radius + kRounding * glm::length(chord);
    return world.sweep({position + half_rise, radius, half_rise}, chord, rules.mask, false);
}

} // namespace

std::optional<Contact> fly(const World& world, const FlightRules& rules, Flight& flight,
                           double until) {
    for (;;) {
        const Arc arc = next_arc(rules, flight);
        const Vec3 chord = arc.at(arc.duration);
        const bool straight = arc.rise() + kRounding * glm::length(chord) <= kStraight;
        const std::optional<Contact> contact =
            straight ? world.sweep({flight.position, rules.radius + kSkin}, chord, rules.mask)
                     : sweep_around(world, rules, arc, flight.position);
        const double free = contact ? contact->t * arc.duration : arc.duration;
        if (flight.time + free > until) return std::nullopt;
        if (free > 0) advance(arc, free, flight);
        if (!contact) {
            flight.window = std::min(kGrowth * arc.duration, kLongestWindow);
        } else if (straight) {
            return contact;
        } else {
            flight.window = arc.duration / kCut;
        }
    }
}

Flight state_at(const FlightRules& rules, const Flight& flight, double time) {
    Flight state = flight;
    advance(next_arc(rules, flight), time - flight.time, state);
    return state;
}

} // namespace peregrine::gameplay
