#pragma once

#include "accel/instances/tree.h"
#include "base/memory.h"

#include <span>

namespace peregrine::accel::instances {

// A tree over instances, of which each lies in one leaf, by halving them along the axis in which
// their centres spread most. `nodes` is overwritten; its memory is used again.
void build(std::span<const Extent> extents, base::Vector<uint32_t>& order,
           base::Vector<Node>& nodes);

} // namespace peregrine::accel::instances
