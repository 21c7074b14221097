#pragma once

#include "accel/bvh/binary_tree.h"
#include "accel/reference.h"

#include <span>

namespace peregrine::accel::bvh {

inline constexpr uint32_t kMaxTreelet = 16;

struct TreeletLeaves {
    uint32_t most;  // references in one
    uint32_t first; // number of the treelet's first reference
};

// Builds the nodes over few references by trying every plane between their centres, and sorts the
// references so that each leaf's are side by side.
void build_treelet(std::span<Reference> references, const TreeletLeaves& leaves,
                   base::Vector<BinaryNode>& nodes);

} // namespace peregrine::accel::bvh
