#include "gameplay/rolling.h"

#include "gameplay/flight.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace peregrine::gameplay {
namespace {

constexpr double kStill = 1e-4;   // m/s
constexpr double kPressed = 1e-3; // of gravity
constexpr double kReach = 4 * kSkin;

Vec3 reaction(const RollingRules& rules, const Contacts& contacts) {
    return constrain(rules.gravity, contacts.normals()) - rules.gravity;
}

bool is_held(const RollingRules& rules, const Contacts& contacts) {
    const Vec3 pressure = reaction(rules, contacts);
    const Vec3 pull = (rules.gravity + pressure) / (1 + rules.inertia);
    return glm::length(pull) <= rules.friction * glm::length(pressure);
}

// Round an edge a ball keeps its speed; into a rising surface it loses what points there.
Vec3 turn(const Vec3& velocity, const Contacts& contacts) {
    const Vec3 held = constrain(velocity, contacts.normals());
    if (contacts.count() != 1) return held;
    const Vec3& normal = contacts.normals()[0];
    const double parting = glm::dot(held, normal);
    const Vec3 along = held - parting * normal;
    const double length = glm::length(along);
    return parting > 0 && length > 0 ? (glm::length(held) / length) * along : held;
}

} // namespace

Vec3 pay_for_lift(const Vec3& velocity, double work, double inertia) {
    const double speed2 = glm::dot(velocity, velocity);
    if (work <= 0 || speed2 == 0) return velocity;
    const double left = std::max(0.0, speed2 - 2 * work / (1 + inertia));
    return std::sqrt(left / speed2) * velocity;
}

bool is_pressed(const RollingRules& rules, const Contacts& contacts) {
    return glm::length(reaction(rules, contacts)) > kPressed * glm::length(rules.gravity);
}

std::optional<Stretch> next_stretch(const RollingRules& rules, const Rolling& ball,
                                    double duration) {
    const Vec3 pressure = reaction(rules, ball.contacts);
    const Vec3 pull = (rules.gravity + pressure) / (1 + rules.inertia);
    const double resistance = rules.friction * glm::length(pressure);
    const double speed = glm::length(ball.velocity);
    Vec3 acceleration;
    if (speed < kStill) {
        const double strength = glm::length(pull);
        if (strength <= resistance) return std::nullopt;
        acceleration = (1 - resistance / strength) * pull;
    } else {
        const double slowing = resistance - glm::dot(pull, ball.velocity) / speed;
        if (slowing * duration > speed) duration = speed / slowing;
        // Friction against the way that the pull has turned it to by then: one that turned it
        // itself could sway for ever.
        const Vec3 pulled = ball.velocity + duration * pull;
        const double length = glm::length(pulled);
        const double kept = length > 0 ? std::max(0.0, 1 - resistance * duration / length) : 0;
        acceleration = (kept * pulled - ball.velocity) / duration;
    }
    return Stretch{ball.velocity + 0.5 * duration * acceleration, acceleration, duration};
}

// On an edge the normal turns with the ball from the first millimetre on, as it does on no face;
// a quarter of the radius further the edge must be too steep to be held on.
bool is_tipping(const World& world, const RollingRules& rules, const Rolling& ball) {
    if (ball.contacts.count() != 1) return false;
    const Vec3& normal = ball.contacts.normals()[0];
    const Vec3 pull = constrain(rules.gravity, ball.contacts.normals());
    const double strength = glm::length(pull);
    if (strength == 0) return false;
    const Vec3 down = pull / strength;
    const auto normal_at = [&](double further) {
        const auto ground =
            world.nearest(ball.position + further * down, rules.radius + further, rules.mask);
        return ground ? ground->normal : normal;
    };
    constexpr double kLittle = 1.0 / 64, kFar = 1.0 / 4; // of the radius
    if (glm::dot(normal_at(kLittle * rules.radius) - normal, down) < 0.5 * kLittle) return false;
    Contacts further;
    further.add(normal_at(kFar * rules.radius));
    return !is_held(rules, further);
}

Rolling follow(const World& world, const RollingRules& rules, const Rolling& ball,
               const Stretch& stretch) {
    const double s = stretch.duration;
    const Vec3 free_end = ball.position + s * ball.velocity + 0.5 * s * s * rules.gravity;
    const Vec3 straight_end = ball.position + stretch.motion();
    Rolling end{straight_end, ball.velocity + s * stretch.acceleration, {}};
    for (const Vec3& normal : ball.contacts.normals()) {
        // As deep as it would have fallen by now.
        const double drop = std::max(0.0, glm::dot(straight_end - free_end, normal));
        const Vec3 probe = -(drop + kReach) * normal;
        const auto ground = world.sweep({end.position, rules.radius}, probe, rules.mask, false);
        if (!ground) continue;
        const Vec3 towards = glm::normalize(ground->normal);
        // What turns away faster than gravity can turn its way is not followed.
        const double turning = std::max(0.0, -s * glm::dot(rules.gravity, towards));
        if (glm::dot(end.velocity, towards) > turning + kStill) continue;
        end.position += ground->t * probe + (ground->depth + kSkin) * towards;
        end.contacts.add(towards);
    }
    const double work = -glm::dot(rules.gravity, end.position - straight_end);
    end.velocity = pay_for_lift(turn(end.velocity, end.contacts), work, rules.inertia);
    end.contacts.drop_parting(end.velocity);
    return end;
}

} // namespace peregrine::gameplay
