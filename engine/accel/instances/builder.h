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

// A tree over instances, of which each is in one leaf, by halving them three times a level along
// the axis in which their centres spread most. Node 0 is its root. `places` and `nodes` are
// overwritten; their memory is used again. Returns the bounds of all.
math::Box build(std::span<const Extent> extents, base::Vector<Place>& places,
                base::Vector<Node>& nodes);

} // namespace peregrine::accel::instances
