#pragma once

#include "accel/bvh/collapse.h"

namespace peregrine::accel::bvh {

// Writes nodes and blocks.
void emit(const Task& task, const base::Vector<BinaryNode>& binary, const Reference* references,
          const WideTree& wide, base::Scheduler& scheduler, Tree& tree);

} // namespace peregrine::accel::bvh
