#pragma once

#include "gameplay/world.h"

#include <optional>

// The flight of a sphere under gravity and drag, with continuous collision: the first impact along
// the arc is found wherever it is, however long the time asked for.
//
// The arc is cut into windows of time. Where a window is free, the flight jumps to its end; where
// something is in the way, to the time up to which nothing can be, and the windows get shorter
// until the arc is as good as straight. The cuts depend on where the flight began and on the
// geometry, never on when it is asked: a flight asked for every 1/30 s and one asked for every
// 1/1000 s go through the same states, bit for bit.
namespace peregrine::gameplay {

// How close to a surface a sphere is stopped. Well above the rounding of a query's floats, so that
// what rests on a surface or slides along it does not touch it.
inline constexpr double kSkin = 1e-6; // metres

struct FlightRules {
    double radius = 0;
    Vec3 gravity{0, -9.81, 0};
    double drag = 0; // deceleration is drag * speed^2; 1/m, >= 0
    Mask mask;
};

struct Flight {
    double time = 0; // s, of position and velocity
    Vec3 position{0};
    Vec3 velocity{0};
    double window = 1.0 / 32; // s, how far to look next
};

// Flies on to the first impact that is not after `until`, and returns it (`t` is of no use).
// Without one it flies to the last window that ends by then: state_at tells of the time in between.
std::optional<Contact> fly(const World& world, const FlightRules& rules, Flight& flight,
                           double until);

// The flight at a time within its window.
Flight state_at(const FlightRules& rules, const Flight& flight, double time);

} // namespace peregrine::gameplay
