#pragma once

#include "accel/bvh/collapse.h"

namespace peregrine::accel::bvh {

// Writes the tree's nodes and blocks, and counts leaves for its report.
void emit(const Task& task, const BinaryTree& binary, const Reference* references,
          const WideTree& wide, base::Scheduler& scheduler, Tree& tree);

} // namespace peregrine::accel::bvh
