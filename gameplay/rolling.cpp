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
        const Vec3 heading = ball.velocity / speed;
        acceleration = pull - resistance * heading;
        const double slowing = -glm::dot(acceleration, heading);
        if (slowing * duration > speed) duration = speed / slowing;
    }
    return Stretch{ball.velocity + 0.5 * duration * acceleration, acceleration, duration};
}

// A little further down the normal has turned with the ball, as it does on no face.
bool is_tipping(const World& world, const RollingRules& rules, const Rolling& ball) {
    if (ball.contacts.count() != 1) return false;
    const Vec3& normal = ball.contacts.normals()[0];
    const Vec3 pull = constrain(rules.gravity, ball.contacts.normals());
    const double strength = glm::length(pull);
    if (strength == 0) return false;
    const Vec3 down = pull / strength;
    const double further = rules.radius / 8;
    const auto below =
        world.nearest(ball.position + further * down, rules.radius + further, rules.mask);
    return below && glm::dot(below->normal - normal, down) > 0.5 * further / rules.radius;
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
