#include "gameplay/push_out.h"

#include "gameplay/flight.h"

#include <glm/geometric.hpp>

namespace peregrine::gameplay {

Vec3 push_out(const World& world, const Capsule& sphere, const Mask& mask) {
    constexpr int kPushes = 64;
    Vec3 center = sphere.center;
    for (int i = 0; i < kPushes; ++i) {
        const auto wall = world.nearest(center, sphere.radius, mask);
        if (!wall) break;
        center = wall->point + (sphere.radius + kSkin) * glm::normalize(wall->normal);
    }
    return center;
}

} // namespace peregrine::gameplay
