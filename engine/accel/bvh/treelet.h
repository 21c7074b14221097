#pragma once

#include "accel/bvh/binary_tree.h"
#include "accel/bvh/reference.h"

#include <span>

namespace peregrine::accel::bvh {

inline constexpr uint32_t kMaxTreelet = 32;

// Builds the nodes over few references by trying every plane between their centres, and sorts the
// references so that each leaf's are side by side. `first` is the number of the first one,
// `leaf` what a leaf may have.
void build_treelet(std::span<Reference> references, uint32_t first, uint32_t leaf,
                   base::Vector<BinaryNode>& nodes);

} // namespace peregrine::accel::bvh
