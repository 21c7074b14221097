#include "gameplay/grenade.h"

#include "gameplay/push_out.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::gameplay {
namespace {

constexpr double kLongestStretch = 1.0 / 128, kShortestStretch = 1.0 / 4096; // s
constexpr double kFirstWindow = 1.0 / 4096;                                  // s
constexpr double kOverlap = 1e-5; // m, deeper than any contact of its own
constexpr double kParting = 1e-4; // m/s, off a surface that it is not pressed on
constexpr double kRattle = 1e-3;  // s between bounces
constexpr uint32_t kMostRattles = 32;
constexpr double kDozeWithin = 1e-3, kDozeAfter = 0.5; // m, s
constexpr double kMoveWithin = 4;                      // s
constexpr double kTipping = 1e-3;                      // m/s

FlightRules flight_rules(const GrenadeRules& rules) {
    return {rules.radius, rules.gravity, rules.drag, rules.mask};
}

RollingRules rolling_rules(const GrenadeRules& rules, bool tipping) {
    return {rules.radius, rules.gravity, tipping ? 0 : rules.rolling_friction, rules.inertia(),
            rules.mask};
}

Rolling rolling(const GrenadeState& state) {
    return {state.flight.position, state.flight.velocity, state.contacts};
}

} // namespace

Grenade::Grenade(const World& world, const GrenadeRules& rules, double time, const Vec3& position,
                 const Vec3& velocity)
    : rules_(rules), time_(time) {
    state_.flight = {time, position, velocity, kFirstWindow};
    keep_clear(world);
}

void Grenade::advance(const World& world, double time) {
    bounces_.clear();
    keep_clear(world);
    if (state_.motion == Motion::resting && !rests_on(world)) {
        state_.flight.time = time_;
        fly_off();
    }
    time_ = time;
    for (bool more = true; more;)
        more = state_.motion == Motion::flying    ? fly_on(world)
               : state_.motion == Motion::rolling ? roll_on(world)
                                                  : false;
}

Flight Grenade::now() const {
    if (state_.motion == Motion::flying)
        return state_at(flight_rules(rules_), state_.flight, time_);
    Flight flight = state_.flight;
    flight.time = time_;
    if (state_.motion == Motion::resting) return flight;
    const double s = time_ - state_.flight.time;
    if (const auto stretch =
            next_stretch(rolling_rules(rules_, state_.tipping), rolling(state_), state_.stretch)) {
        flight.position += s * stretch->mean_velocity;
        flight.velocity += s * stretch->acceleration;
    }
    return flight;
}

// What cannot be freed stays where it is, and rests on nothing.
void Grenade::keep_clear(const World& world) {
    const Flight here = now();
    const bool stuck = state_.motion == Motion::resting && state_.contacts.count() == 0;
    if (!world.overlaps({here.position, rules_.radius - kOverlap}, rules_.mask)) {
        if (stuck) state_.motion = Motion::flying;
        return;
    }
    const Vec3 freed = push_out(world, {here.position, rules_.radius}, rules_.mask);
    const bool clear = !world.overlaps({freed, rules_.radius - kOverlap}, rules_.mask);
    if (stuck && !clear) return;
    state_.flight = {time_, clear ? freed : here.position, here.velocity, kFirstWindow};
    state_.contacts.clear();
    state_.motion = clear ? Motion::flying : Motion::resting;
    if (!clear) state_.flight.velocity = state_.spin = Vec3(0);
}

// Still on everything that it came to rest on.
bool Grenade::rests_on(const World& world) const {
    return std::ranges::all_of(state_.contacts.normals(), [&](const Vec3& normal) {
        const Vec3 probe = -4 * kSkin * normal;
        return world.sweep({state_.flight.position, rules_.radius}, probe, rules_.mask, false)
            .has_value();
    });
}

bool Grenade::fly_on(const World& world) {
    const auto contact = fly(world, flight_rules(rules_), state_.flight, time_);
    if (!contact) return false;
    lift(contact->depth * glm::normalize(contact->normal));
    state_.contacts.clear();
    meet(*contact);
    return true;
}

// To the distance that it keeps from surfaces; the height is paid for with speed.
void Grenade::lift(const Vec3& way) {
    state_.flight.position += way;
    const double turning = state_.motion == Motion::rolling ? rules_.inertia() : 0;
    state_.flight.velocity =
        pay_for_lift(state_.flight.velocity, -glm::dot(rules_.gravity, way), turning);
}

// Slow impacts end on the surface: there the ball grips at once, and rolls.
void Grenade::meet(const Contact& contact) {
    const Vec3 normal = glm::normalize(contact.normal);
    Flight& flight = state_.flight;
    const double approach = std::max(0.0, -glm::dot(flight.velocity, normal));
    if (approach >= rules_.settling_speed) bounces_.push_back({contact, flight.time, approach});
    state_.rattles = flight.time - state_.last_bounce < kRattle ? state_.rattles + 1 : 0;
    state_.last_bounce = flight.time;
    const bool settles =
        rules_.restitution * approach < rules_.settling_speed || state_.rattles > kMostRattles;

    const BounceRules bounce_rules{rules_.radius, settles ? 0 : rules_.restitution,
                                   rules_.friction};
    set(bounce(bounce_rules, {flight.velocity, state_.spin}, normal, approach));
    flight.window = kFirstWindow;
    if (!settles) {
        fly_off();
        return;
    }
    state_.contacts.add(normal);
    if (!is_pressed(rolling_rules(rules_, false), state_.contacts)) {
        fly_off();
        return;
    }
    flight.velocity -= glm::dot(flight.velocity, normal) * normal;
    if (state_.motion == Motion::flying)
        set(grip(bounce_rules, {flight.velocity, state_.spin}, normal));
    flight.velocity = constrain(flight.velocity, state_.contacts.normals());
    state_.contacts.drop_parting(flight.velocity);
    state_.motion = Motion::rolling;
    state_.stretch = kLongestStretch;
    note_place();
}

// A little away from what it touched, lest the next look should take it for an impact.
void Grenade::fly_off() {
    for (const Vec3& normal : state_.contacts.normals()) {
        const double parting = glm::dot(state_.flight.velocity, normal);
        state_.flight.velocity += std::max(0.0, kParting - parting) * normal;
    }
    state_.flight.window = kFirstWindow;
    state_.motion = Motion::flying;
    state_.contacts.clear();
}

void Grenade::set(const Spinning& body) {
    state_.flight.velocity = body.velocity;
    state_.spin = body.spin;
}

// As it must to roll without slipping.
void Grenade::turn() {
    if (rules_.friction == 0) return;
    const Vec3& ground = state_.contacts.normals()[0];
    state_.spin = glm::cross(ground, state_.flight.velocity) / rules_.radius;
}

// What stays within a millimetre has come to rest, however it trembles there.
void Grenade::note_place() {
    if (glm::distance(state_.flight.position, state_.anchor) <= kDozeWithin) return;
    state_.anchor = state_.flight.position;
    state_.anchor_time = state_.flight.time;
}

// What it does until the next event: nothing, once it rests. Close to balance what tips over would
// stay for seconds: it gets a push too small to see.
std::optional<Stretch> Grenade::plan(const World& world) {
    const RollingRules rules = rolling_rules(rules_, false);
    auto stretch = next_stretch(rules, rolling(state_), state_.stretch);
    const bool stops = !stretch || stretch->duration < state_.stretch;
    state_.tipping = stops && is_tipping(world, rules, rolling(state_));
    if (state_.tipping) {
        const Vec3 pull = constrain(rules.gravity, state_.contacts.normals());
        if (glm::length(state_.flight.velocity) < kTipping)
            state_.flight.velocity = kTipping * glm::normalize(pull);
        stretch = next_stretch(rolling_rules(rules_, true), rolling(state_), state_.stretch);
    }
    const double patience = stops && !state_.tipping ? kDozeAfter : kMoveWithin;
    if (state_.flight.time - state_.anchor_time > patience) return std::nullopt;
    return stretch;
}

bool Grenade::roll_on(const World& world) {
    if (!is_pressed(rolling_rules(rules_, false), state_.contacts)) {
        fly_off();
        return true;
    }
    const auto stretch = plan(world);
    if (!stretch) {
        state_.flight.velocity = state_.spin = Vec3(0);
        state_.motion = Motion::resting;
        return true;
    }
    const auto contact =
        world.sweep({state_.flight.position, rules_.radius}, stretch->motion(), rules_.mask);
    return contact ? roll_into(*stretch, *contact) : roll_along(world, *stretch);
}

// Part of a stretch, up to something in the way.
bool Grenade::roll_into(const Stretch& stretch, const Contact& contact) {
    Flight& flight = state_.flight;
    const double s = contact.t * stretch.duration;
    if (flight.time + s > time_) return false;
    flight.position += s * stretch.mean_velocity;
    flight.velocity += s * stretch.acceleration;
    flight.time += s;
    turn();
    lift((contact.depth + kSkin) * glm::normalize(contact.normal));
    meet(contact);
    return true;
}

// A whole stretch. Where it leads off the ground, the place is found by shorter ones.
bool Grenade::roll_along(const World& world, const Stretch& stretch) {
    const RollingRules rules = rolling_rules(rules_, state_.tipping);
    const Rolling end = follow(world, rules, rolling(state_), stretch);
    const bool lost = end.contacts.count() == 0;
    if (lost && state_.stretch > kShortestStretch) {
        state_.stretch = std::max(kShortestStretch, state_.stretch / 4);
        return true;
    }
    const double time = state_.flight.time + stretch.duration;
    if (time > time_) return false;
    state_.flight = {time, end.position, end.velocity, kFirstWindow};
    state_.contacts = end.contacts;
    state_.stretch = std::min(kLongestStretch, 2 * state_.stretch);
    if (lost) {
        state_.motion = Motion::flying;
        return true;
    }
    turn();
    note_place();
    return true;
}

void Grenade::add_to(StateHash& hash) const {
    const Flight& flight = state_.flight;
    hash.add(uint32_t(state_.motion));
    for (const Vec3& v : {flight.position, flight.velocity, state_.spin, state_.anchor})
        hash.add(v);
    for (const double x : {time_, flight.time, flight.window, state_.stretch, state_.anchor_time,
                           state_.last_bounce})
        hash.add(x);
    for (const Vec3& normal : state_.contacts.normals()) hash.add(normal);
    hash.add(uint64_t(state_.contacts.count()));
    hash.add(state_.tipping);
    hash.add(state_.rattles);
}

Vec3 reach(const World& world, const Vec3& eye, const Vec3& hand, double radius, const Mask& mask) {
    const auto wall = world.sweep({eye, radius + kSkin}, hand - eye, mask, false);
    return wall ? eye + wall->t * (hand - eye) : hand;
}

} // namespace peregrine::gameplay
