#pragma once

#include "accel/instances/tree.h"

#include <span>

namespace peregrine::accel::instances {

// What an instance fills of the world, in double. Rays may hit what the box holds once it is
// widened by margin + slope * (their origin's distance from it), with the slope of its Extent.
struct ExactExtent {
    math::Vec3d lower, upper;
    float margin = 0;

    void extend(const ExactExtent& other);
};

// Beside a node of a tree whose instances are far from the world's origin, as seen from their size:
// what floats have left of the children's bounds, to be added to them, and margins that do not grow
// with where they are.
struct alignas(64) NodeRest {
    float lower[3][kWidth];
    float upper[3][kWidth];
    float margin[kWidth];
};
static_assert(sizeof(NodeRest) == 256);

// Whether such rests are worth what a ray pays for them: margins, or what shapes have instead, are
// no longer small beside the instances.
bool are_far(std::span<const Extent> extents, const math::Box& bounds);

// Of a tree's nodes; `extents` are those of the instances.
void find_rests(std::span<const Node> nodes, std::span<const ExactExtent> extents,
                base::Memory* memory, base::Vector<NodeRest>& rests);

} // namespace peregrine::accel::instances
