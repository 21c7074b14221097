#pragma once

#include "accel/bvh/binary_tree.h"
#include "accel/bvh/partition.h"

namespace peregrine::accel::bvh {

// What one thread builds.
struct Subtree {
    Subtree(uint32_t top_node, const Range& all, base::Memory* memory)
        : node(top_node), range(all), nodes(memory) {}

    uint32_t node; // among the top ones
    Range range;
    base::Vector<BinaryNode> nodes;
};

// Of the time that a build takes, about.
inline constexpr float kShareOfTop = 0.4f;

// Splits level by level until ranges are small enough for one thread each. These depend on the
// triangles alone, not on the number of threads. Incomplete if cancelled.
void build_top(const Task& task, Arena& arena, const Range& root, base::Scheduler& scheduler,
               base::Vector<BinaryNode>& nodes, base::Vector<Subtree>& subtrees);

} // namespace peregrine::accel::bvh
