#pragma once

#include "accel/bvh/agglomeration.h"
#include "accel/bvh/collapse.h"

namespace peregrine::accel::bvh {

// Writes the tree's nodes and blocks, and counts leaves for its report. Leaves of the binary tree
// refer to references or to members.
void emit(const Task& task, const BinaryTree& binary, const Reference* references,
          const WideTree& wide, base::Scheduler& scheduler, Tree& tree);
void emit(const Task& task, const BinaryTree& binary, const Members& members, const WideTree& wide,
          base::Scheduler& scheduler, Tree& tree);

} // namespace peregrine::accel::bvh
