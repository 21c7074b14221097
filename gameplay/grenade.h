#pragma once

#include "gameplay/bounce.h"
#include "gameplay/contacts.h"
#include "gameplay/flight.h"
#include "gameplay/rolling.h"
#include "gameplay/state_hash.h"

#include <vector>

// A grenade: a ball that flies, bounces, rolls and comes to rest. Its motion is a chain of events
// (impacts, ends of windows and of stretches of rolling) whose times follow from the throw and the
// level, not from the time step of the game; docs/gameplay.md has the rules.
namespace peregrine::gameplay {

struct GrenadeRules {
    double radius = 0.075;
    Vec3 gravity{0, -9.81, 0};
    double drag = 0;               // 1/m: deceleration in flight is drag * speed^2
    double restitution = 0.45;     // 0 to 1
    double friction = 0.5;         // Coulomb's, at impacts; 0: it never turns and slides for ever
    double rolling_friction = 0.1; // deceleration over the pressure on the ground
    double settling_speed = 0.1;   // m/s: what would bounce off slower than this does not
    Mask mask;                     // its list must live as long as what flies

    double inertia() const { return friction > 0 ? 0.4 : 0; }
};

enum class Motion : uint32_t { flying, rolling, resting };

struct GrenadeState {
    Motion motion = Motion::flying;
    Flight flight; // where it was at the last event; `window` matters to a flight alone
    Vec3 spin{0};
    Contacts contacts;          // that it rolls or rests on
    double stretch = 1.0 / 128; // s, of rolling to look ahead
    Vec3 anchor{0};             // where it was at `anchor_time`; near there since
    double anchor_time = 0;
    double last_bounce = -1; // s
    uint32_t tipping = 0;    // 1: over an edge, where friction does not hold it
    uint32_t rattles = 0;    // bounces one right after the other
};

// For sounds and sparks.
struct Bounce {
    Contact contact;
    double time;
    double approach; // m/s
};

class Grenade {
public:
    // In flight from `position`, at game time `time`. Where it would be inside something it is
    // pushed out first.
    Grenade(const World& world, const GrenadeRules& rules, double time, const Vec3& position,
            const Vec3& velocity);

    // To the game's time `time`, not before that of the last call. What moved in the world since
    // then, and now overlaps the grenade, pushes it out.
    void advance(const World& world, double time);

    double time() const { return time_; }
    Motion motion() const { return state_.motion; }
    Vec3 position() const { return now().position; }
    Vec3 velocity() const { return now().velocity; }
    Vec3 spin() const { return state_.spin; }
    const GrenadeRules& rules() const { return rules_; }
    void add_to(StateHash& hash) const;
    const GrenadeState& state() const { return state_; }         // all of it, beside time()
    std::span<const Bounce> bounces() const { return bounces_; } // during the last advance

private:
    Flight now() const;
    void keep_clear(const World& world);
    bool fly_on(const World& world);
    bool roll_on(const World& world);
    bool roll_into(const Stretch& stretch, const Contact& contact);
    bool roll_along(const World& world, const Stretch& stretch);
    std::optional<Stretch> plan(const World& world);
    bool rests_on(const World& world) const;
    void meet(const Contact& contact);
    void lift(const Vec3& way);
    void fly_off();
    void set(const Spinning& body);
    void note_place();
    void turn();

    GrenadeRules rules_;
    GrenadeState state_;
    double time_;
    std::vector<Bounce> bounces_;
};

// Where a hand at `hand` lets go of a ball without putting it through a wall: as far from the eye
// towards the hand as there is room.
Vec3 reach(const World& world, const Vec3& eye, const Vec3& hand, double radius,
           const Mask& mask = {});

} // namespace peregrine::gameplay
