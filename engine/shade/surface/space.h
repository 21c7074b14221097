#pragma once

#include "scene/placement.h"
#include "trace/world/world.h"

namespace peregrine::shade {

// What positions of surfaces are relative to, and what the errors of shadow rays grow with. These
// start at a surface, or at a light near the world (scene::is_near) that is not farther than
// light_reach.
struct SurfaceSpace {
    math::Vec3d origin{0};     // relative to the world's, and ...
    bool is_elsewhere = false; // ... whether it is another
    float world_size = 0;
    float fixed_size = 0; // of what does not move
    float light_reach = 0;
    float fixed_reach = 0; // how far from a fixed triangle its shadow rays may start

    // `light_radius`: the largest one of those lights.
    SurfaceSpace(const trace::World& world, const math::Vec3d& origin, float light_radius);

    // How far from a triangle of a mesh that moves; null: its vertices are where they are.
    float reach_of(const math::Box& bounds, const scene::Placement* placement) const;
};

} // namespace peregrine::shade
