#pragma once

#include "gameplay/flight.h"

#include <vector>

namespace peregrine::gameplay {

struct ProjectileRules {
    double radius = 0.0025;
    Vec3 gravity{0}; // none: it flies straight
    double drag = 0; // 1/m
    // It glances off where the sine of the angle between its way and the surface is at most this;
    // 0: it never does.
    double ricochet_sine = 0;
    double ricochet_restitution = 0.3; // of the speed towards the surface
    double ricochet_keep = 0.8;        // of the speed along it
    uint32_t most_ricochets = 4;
    Mask mask; // its list must live as long as what flies
};

struct ProjectileHit {
    double time;   // s
    Vec3 point;    // on the surface
    Vec3 normal;   // unit, from the surface to the projectile
    Vec3 velocity; // on arrival
    rt_mesh mesh;
    uint32_t triangle;
    bool ricochet; // it flew on
};

// A bullet: a small fast sphere, which meets the first thing in its way however fast it is and
// however long the time step, and stops there or glances off. Like all flights it goes through the
// same states at any time step.
class Projectile {
public:
    Projectile(const ProjectileRules& rules, double time, const Vec3& position,
               const Vec3& velocity);

    // To the game's time `time`, or to where it stops. Returns what it hit on the way, in order;
    // valid until the next call.
    std::span<const ProjectileHit> advance(const World& world, double time);

    bool is_spent() const { return spent_; }
    Vec3 position() const { return now().position; }
    Vec3 velocity() const { return now().velocity; }

private:
    Flight now() const;
    bool glances_off(const Contact& contact) const;
    void glance_off(const Vec3& normal);

    ProjectileRules rules_;
    Flight flight_;
    double time_;
    uint32_t ricochets_ = 0;
    bool spent_ = false;
    std::vector<ProjectileHit> hits_;
};

} // namespace peregrine::gameplay
