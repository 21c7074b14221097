#pragma once

#include "accel/bvh/binary_tree.h"
#include "accel/bvh/partition.h"
#include "accel/bvh/task.h"

namespace peregrine::accel::bvh {

// Splits a range of more than a leaf's references.
void split_range(const Task& task, Arena& arena, const Range& range, Range& left, Range& right);

// Adds the subtree's nodes, with indices within `nodes`. Incomplete if cancelled.
void build_subtree(const Task& task, Arena& arena, const Range& range,
                   base::Vector<BinaryNode>& nodes);

} // namespace peregrine::accel::bvh
