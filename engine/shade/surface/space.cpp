#include "shade/surface/space.h"

#include "geometry/lift.h"

#include <algorithm>

namespace peregrine::shade {

// Lights that shine farther than a level is large do not make all of a wide world's surfaces rise.
SurfaceSpace::SurfaceSpace(const trace::World& world, const math::Vec3d& origin_,
                           float light_radius)
    : origin(origin_), is_elsewhere(origin_ != math::Vec3d(0)),
      world_size(geometry::largest_side(world.bounds)),
      fixed_size(geometry::largest_side(world.fixed.target.bounds)) {
    constexpr float kLevel = 256; // metres
    light_reach = std::min({light_radius, world_size, std::max(fixed_size, kLevel)});
    fixed_reach = std::min(world_size, fixed_size + light_reach);
}

// Of a mesh that moves, in the world. Within a space of its own, what a ray's rounded origin is off
// grows with the mesh's coordinates, which twice the largest covers, too.
float SurfaceSpace::reach_of(const math::Box& bounds, const scene::Placement* placement) const {
    if (!placement) return std::min(world_size, geometry::largest_side(bounds) + light_reach);
    const math::Vec3 most = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
    const auto own = float(placement->to_world.norm()) * 2 * std::max({most.x, most.y, most.z});
    const auto condition = float(placement->condition);
    return std::min(condition * world_size, own + condition * light_reach);
}

} // namespace peregrine::shade
