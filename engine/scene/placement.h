#pragma once

#include "math/affine.h"

namespace peregrine::scene {

// Where a rigid mesh stands, relative to the world's origin.
struct Placement {
    math::Affine to_world;
    math::Affine to_local;
    double condition = 1; // the product of their norms: how much errors may grow
    bool mirrored = false;
};

inline Placement place(const math::Affine& transform, const math::Vec3d& origin) {
    Placement placement;
    placement.to_world = transform;
    placement.to_world.offset -= origin;
    placement.to_local = math::inverse(placement.to_world);
    placement.condition = placement.to_world.norm() * placement.to_local.norm();
    placement.mirrored = math::determinant(transform) < 0;
    return placement;
}

} // namespace peregrine::scene
