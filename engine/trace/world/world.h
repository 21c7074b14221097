#pragma once

#include "accel/instances/rest.h"
#include "accel/instances/tree.h"
#include "math/affine.h"
#include "trace/kernels.h"
#include "trace/world/position.h"

#include <array>
#include <cstdint>

namespace peregrine::trace {

// Triangles under one structure. Those of the whole world are numbered through: `first` is the
// number of triangle 0 here.
struct Part {
    Target target{};
    const Kernels* kernels = nullptr;
    uint32_t first = 0;
};

// What an instance has in the place of Filter::alpha, by Asks.
using InstanceTests = std::array<AlphaTest, kAsks>;

// A mesh that moves. One with a space of its own stands somewhere in the world: what a ray hits
// there is, by definition, what the canonical test says of the ray in that space (to_local).
struct Instance {
    math::Affine to_local;
    math::Vec3d origin; // of its space, relative to the world's
    Part part;
    uint32_t mesh; // slot; takes the place of that in the target's infos
    uint32_t layer_mask;
    InstanceTests tests;                    // of this mesh, for filters that have one
    const math::Affine* to_world = nullptr; // null without a space of its own
    bool mirrored = false;                  // by to_world

    bool has_own_space() const { return to_world != nullptr; }
};

struct RayLists; // trace/world/ray_lists.h

// Everything that a ray can hit.
struct World {
    Part fixed;
    const RayLists* ray_lists = nullptr;               // of the instruction set of `fixed`
    const accel::instances::Node* nodes = nullptr;     // over the instances; null: none
    const accel::instances::NodeRest* rests = nullptr; // of the nodes; null: none is far away
    math::Box moving_bounds;                           // of all of them
    const Instance* instances = nullptr;               // in ascending order of Part::first
    uint32_t instance_count = 0;
    uint32_t first_moving = 0; // number of the first triangle that is not fixed
    math::Box bounds;
};

// Whose triangle it is; not for kNoTriangle.
geometry::TriangleInfo moving_info(const World& world, uint32_t triangle);

inline geometry::TriangleInfo info(const World& world, uint32_t triangle) {
    if (triangle < world.first_moving) [[likely]]
        return world.fixed.target.infos[triangle];
    return moving_info(world, triangle);
}

// Whether rays within the box may hit anything that moves; for worlds that have `nodes`.
bool moving_may_meet(const World& world, const math::Box& box);

// The ray in an instance's space, given its origin as seen from that of the space. False if nothing
// is left of it there: its direction vanishes, or its origin lies beyond 1e30.
inline bool to_local(const math::Affine& to_local, const math::Vec3d& seen, const math::Ray& ray,
                     math::Ray& local) {
    const math::Vec3 origin(to_local.vector(seen));
    const math::Vec3 direction(to_local.vector(math::Vec3d(ray.direction)));
    local = {origin, ray.t_min, direction, ray.t_max};
    const auto largest = [](const math::Vec3& v) {
        return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    };
    const float length = largest(direction);
    return largest(origin) <= 1e30f && length > 0 && length <= std::numeric_limits<float>::max();
}

// What an instance whose mesh fills `local` fills of the world.
//
// A hit at t lies, in the instance's space, within 8.1 e D of a point Q of the mesh, D <= |o'| + R,
// where o' is the rounded local origin, R the largest |coordinate| of the mesh, e = 2^-24
// (slabs.h). Rounding o' and d' moves the local ray at that t by e |o'| and e (R + 2 |o'|) or less.
// Back in the world, where lengths grow by at most |M|, the ray is within
//     |M| (12 e + c 2^-48) (|W| |o| + |w| + R)
// of M Q; W and w are the map to local space, M its inverse, c = |M| |W| bounds what both lose in
// double. A slab test in float, of an origin that is rounded to float, errs by less than
// 2^-20 (|o| + C), C the box's largest |coordinate|.
accel::instances::Extent extent_of(const math::Affine& to_world, const math::Affine& to_local,
                                   const math::Box& local);

// ... of one without a space of its own: nothing is transformed, and the slab test of slabs.h asks
// for the triangles' bounds alone.
accel::instances::Extent extent_of(const math::Box& bounds);

// The same for nodes with rests. There a slab test has boxes relative to the ray's origin, which
// both are known to 2^-46 of their size, so it errs by less than 2^-20 d + 2^-46 (|o| + C), d the
// largest distance from the origin to a corner along an axis. And |o'| is at most |W| d + R.
accel::instances::ExactExtent exact_extent_of(const Instance& instance);

} // namespace peregrine::trace
