#pragma once

#include "accel/bvh/tree.h"

namespace peregrine::accel::bvh {

// Fills `order` of a node whose first `children` places are taken: children by how far their
// middles are along each octant's diagonal.
void sort_front_to_back(Node& node, uint32_t children);

} // namespace peregrine::accel::bvh
