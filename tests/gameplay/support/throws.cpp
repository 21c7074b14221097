#include "support/throws.h"

#include <glm/geometric.hpp>

namespace peregrine::test {

Throw random_throw(gameplay::Random& random, const Vec3& lower, const Vec3& upper, double speed) {
    Throw thrown;
    for (int axis = 0; axis < 3; ++axis)
        thrown.position[axis] = random.between(lower[axis], upper[axis]);
    thrown.velocity = speed * random.in_ball();
    return thrown;
}

double energy(const gameplay::Grenade& grenade) {
    const gameplay::GrenadeRules& rules = grenade.rules();
    const gameplay::GrenadeState& state = grenade.state();
    const double turning =
        rules.inertia() * rules.radius * rules.radius * glm::dot(state.spin, state.spin);
    return 0.5 * (glm::dot(state.flight.velocity, state.flight.velocity) + turning)
           - glm::dot(rules.gravity, state.flight.position);
}

double gap(const gameplay::World& world, const gameplay::Grenade& grenade, double reach) {
    const double radius = grenade.rules().radius;
    const auto wall = world.nearest(grenade.position(), radius + reach);
    return wall ? wall->distance - radius : reach;
}

//   ________________________
//  |                        |
//  |        __        /|    |    steps, a box, a ramp; beyond them two walls that lean
//  |  _|-|_ |_|     /  |    |    towards one another
//  |_|_____|_______/___|____|
void add_playground(Arena& arena) {
    arena.add_room({-5, 0, -5}, {5, 4, 5});
    arena.add_box({1, 0, 1}, {2, 1, 2});
    for (int i = 0; i < 4; ++i)
        arena.add_box({-3 - 0.3 * i, 0, -3}, {-2.7 - 0.3 * i, 0.2 * (i + 1), -1});
    arena.add_quad({0, 0, -4}, {0, 0, -2}, {3, 1.5, -2}, {3, 1.5, -4});
    arena.add_quad({3, 0, -4}, {3, 1.5, -4}, {3, 1.5, -2}, {3, 0, -2});
    arena.add_quad({-4, 0, 2}, {-4, 1, 2.4}, {-1, 1, 2.4}, {-1, 0, 2});
    arena.add_quad({-4, 0, 3}, {-4, 1, 2.6}, {-1, 1, 2.6}, {-1, 0, 3});
}

} // namespace peregrine::test
