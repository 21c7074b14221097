#include "gameplay/ray_grenade.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::gameplay {
namespace {

constexpr int kMostBounces = 4; // a step
constexpr double kFlat = 0.1;   // cosine, of a way taken for one along the surface

// How far the centre gets along `way` (unit) before a plane stops the sphere.
double room_before(const RayHit& hit, double distance, const Vec3& way, double radius) {
    const double steepness = std::max(kFlat, -glm::dot(way, hit.normal));
    return std::max(0.0, distance - radius / steepness);
}

Vec3 reflect(const GrenadeRules& rules, const Vec3& velocity, const Vec3& normal) {
    const double approach = std::max(0.0, -glm::dot(velocity, normal));
    const Vec3 along = velocity + approach * normal;
    const double speed = glm::length(along);
    const double push = (1 + rules.restitution) * approach;
    const double kept = speed > 0 ? std::max(0.0, 1 - rules.friction * push / speed) : 0;
    const double back = rules.restitution * approach;
    return kept * along + (back < rules.settling_speed ? 0 : back) * normal;
}

} // namespace

void step(const World& world, const GrenadeRules& rules, RayGrenade& grenade, double seconds) {
    grenade.velocity += seconds * rules.gravity;
    double left = seconds;
    for (int i = 0; i < kMostBounces && left > 0; ++i) {
        const double speed = glm::length(grenade.velocity);
        if (speed == 0) return;
        const Vec3 way = grenade.velocity / speed;
        // Far enough to see what the front of the sphere would meet, however flat.
        const double sight = left * speed + rules.radius / kFlat;
        const auto hit = world.closest(grenade.position, sight * way, rules.mask);
        const double room =
            hit ? room_before(*hit, hit->t * sight, way, rules.radius) : left * speed;
        if (room >= left * speed) {
            grenade.position += left * grenade.velocity;
            return;
        }
        grenade.position += room * way;
        left -= room / speed;
        grenade.velocity = reflect(rules, grenade.velocity, hit->normal);
    }
}

} // namespace peregrine::gameplay
