#pragma once

#include "accel/bvh/binary_tree.h"
#include "accel/bvh/task.h"

#include <array>

namespace peregrine::accel::bvh {

// A wide node by the roots of its children among the binary nodes.
struct WideNode {
    uint32_t children[kWidth];
    uint32_t links[kWidth]; // of wide nodes, or kLeaf with the first block and the count
    uint32_t count;
};

struct WideTree {
    explicit WideTree(base::Memory* memory) : nodes(memory) {}

    base::Vector<WideNode> nodes; // depth-first
    uint64_t blocks = 0;
    uint32_t depth = 0;
    double cost = 0;
};

// Makes the cheapest tree of 8 children a node.
WideTree collapse(const Task& task, const base::Vector<BinaryNode>& nodes);

} // namespace peregrine::accel::bvh
