#pragma once

#include "accel/bvh/binary_tree.h"
#include "accel/bvh/partition.h"
#include "accel/bvh/task.h"

namespace peregrine::accel::bvh {

// Splits the root's range until leaves are small: the levels at the top in step, what is below them
// subtree by subtree, in parallel.
BinaryTree build_top_down(const Task& task, Arena& arena, const Range& root,
                          base::Scheduler& scheduler);

} // namespace peregrine::accel::bvh
