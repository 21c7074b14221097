#pragma once

#include "accel/bvh/binary_tree.h"
#include "accel/bvh/task.h"

namespace peregrine::accel::bvh {

// Moves subtrees to where they make the nodes' areas smaller: the insertion-based optimisation of
// Bittner, Hapala and Havran 2013, searching in parallel as Meister and Bittner 2018. If the effort
// has rounds of it, the tree has one part afterwards.
void reinsert(const Task& task, base::Scheduler& scheduler, BinaryTree& tree);

} // namespace peregrine::accel::bvh
