#pragma once

#include "gameplay/contacts.h"

#include <optional>

// A ball that rolls without slipping, pressed by gravity on up to three surfaces.
namespace peregrine::gameplay {

struct RollingRules {
    double radius = 0;
    Vec3 gravity{0};
    double friction = 0; // of rolling: deceleration over the pressure
    double inertia = 0;  // over mass radius^2; 0: it slides, without any friction
    Mask mask;
};

struct Rolling {
    Vec3 position{0};
    Vec3 velocity{0};
    Contacts contacts;
};

// A straight piece of its way. The velocity changes evenly.
struct Stretch {
    Vec3 mean_velocity, acceleration;
    double duration;

    Vec3 motion() const { return duration * mean_velocity; }
};

// The velocity that is left when `work` (m^2/s^2) has been done against gravity.
Vec3 pay_for_lift(const Vec3& velocity, double work, double inertia);

// Whether gravity presses it on its contacts at all.
bool is_pressed(const RollingRules& rules, const Contacts& contacts);

// At most `duration` long; it ends where friction stops the ball. None: it rests.
std::optional<Stretch> next_stretch(const RollingRules& rules, const Rolling& ball,
                                    double duration);

// On an edge or a tip that it would roll off further and further, were it not for friction: nothing
// that a ball can rest on.
bool is_tipping(const World& world, const RollingRules& rules, const Rolling& ball);

// After the whole of a stretch with nothing in its way: on the surfaces that are still near enough
// for gravity to have kept it there. No contacts: it left the ground.
Rolling follow(const World& world, const RollingRules& rules, const Rolling& ball,
               const Stretch& stretch);

} // namespace peregrine::gameplay
