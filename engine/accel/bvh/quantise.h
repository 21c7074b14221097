#pragma once

#include "accel/bvh/compact_tree.h"

namespace peregrine::accel::bvh {

// Sets the frame and the planes of the first `children` children: those of `node`, or beyond as far
// as bytes ask for. What CompactNode::plane gives contains each box.
void quantise(const Node& node, uint32_t children, CompactNode& out);

} // namespace peregrine::accel::bvh
