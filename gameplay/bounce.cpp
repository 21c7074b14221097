#include "gameplay/bounce.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace peregrine::gameplay {
namespace {

// Of the point of the sphere that touches, along the surface.
Vec3 slip(const BounceRules& rules, const Spinning& body, const Vec3& normal) {
    const Vec3 velocity = body.velocity - rules.radius * glm::cross(body.spin, normal);
    return velocity - glm::dot(velocity, normal) * normal;
}

// An impulse at the point of contact, against the slip: no more than what stops it.
Spinning rub(const BounceRules& rules, const Spinning& body, const Vec3& normal, double most) {
    const Vec3 sliding = slip(rules, body, normal);
    const double speed = glm::length(sliding);
    if (speed == 0 || rules.friction == 0) return body;
    const double pull = std::min(most, speed * rules.inertia / (1 + rules.inertia));
    const Vec3 turn = glm::cross(normal, sliding) / (rules.inertia * rules.radius);
    return {body.velocity - (pull / speed) * sliding, body.spin + (pull / speed) * turn};
}

} // namespace

Spinning bounce(const BounceRules& rules, const Spinning& body, const Vec3& normal,
                double approach) {
    const double push = (1 + rules.restitution) * approach;
    return rub(rules, {body.velocity + push * normal, body.spin}, normal, rules.friction * push);
}

Spinning grip(const BounceRules& rules, const Spinning& body, const Vec3& normal) {
    return rub(rules, body, normal, std::numeric_limits<double>::infinity());
}

} // namespace peregrine::gameplay
