#include "gameplay/projectile.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::gameplay {
namespace {

constexpr double kParting = 1e-4; // m/s, at least, off what it glanced off

FlightRules flight_rules(const ProjectileRules& rules) {
    return {rules.radius, rules.gravity, rules.drag, rules.mask};
}

} // namespace

Projectile::Projectile(const ProjectileRules& rules, double time, const Vec3& position,
                       const Vec3& velocity)
    : rules_(rules), time_(time) {
    flight_.time = time;
    flight_.position = position;
    flight_.velocity = velocity;
}

std::span<const ProjectileHit> Projectile::advance(const World& world, double time) {
    hits_.clear();
    if (spent_) return hits_;
    time_ = time;
    while (const auto contact = fly(world, flight_rules(rules_), flight_, time)) {
        const Vec3 normal = glm::normalize(contact->normal);
        const bool ricochet = glances_off(*contact);
        hits_.push_back({flight_.time, contact->point, normal, flight_.velocity, contact->mesh,
                         contact->triangle, ricochet});
        if (ricochet) {
            glance_off(normal);
            continue;
        }
        spent_ = true;
        flight_.velocity = Vec3(0);
        break;
    }
    return hits_;
}

Flight Projectile::now() const {
    return spent_ ? flight_ : state_at(flight_rules(rules_), flight_, time_);
}

bool Projectile::glances_off(const Contact& contact) const {
    const double towards = -glm::dot(flight_.velocity, contact.normal);
    return ricochets_ < rules_.most_ricochets && rules_.ricochet_sine > 0
           && towards <= rules_.ricochet_sine * glm::length(flight_.velocity);
}

void Projectile::glance_off(const Vec3& normal) {
    const double towards = -glm::dot(flight_.velocity, normal);
    const Vec3 along = flight_.velocity + towards * normal;
    flight_.velocity = rules_.ricochet_keep * along
                       + std::max(kParting, rules_.ricochet_restitution * towards) * normal;
    ++ricochets_;
}

} // namespace peregrine::gameplay
