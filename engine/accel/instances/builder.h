#pragma once

#include "accel/instances/tree.h"
#include "base/memory.h"

#include <span>

namespace peregrine::accel::instances {

// Where an instance is.
struct Place {
    math::Vec3 center;
    uint32_t instance;
};

// A tree over instances, of which each lies in one leaf, by halving them along the axis in which
// their centres spread most. `places` and `nodes` are overwritten; their memory is used again.
void build(std::span<const Extent> extents, base::Vector<Place>& places, base::Vector<Node>& nodes);

} // namespace peregrine::accel::instances
