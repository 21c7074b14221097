#pragma once

#include "accel/bvh/choices.h"

namespace peregrine::accel::bvh {

// A wide node by the binary nodes that are its children.
struct WideNode {
    uint32_t children[kWidth];
    // Of a leaf, kLeaf and where its references begin in the list of all leaves' references;
    // otherwise the wide node.
    uint32_t targets[kWidth];
    uint32_t count;
};

struct WideTree {
    explicit WideTree(base::Memory* memory) : nodes(memory) {}

    base::Vector<WideNode> nodes; // depth-first
    uint32_t references = 0;      // of leaves
    uint64_t blocks = 0;
    uint32_t depth = 0;
    double cost = 0; // of a ray through the bounds
};

WideTree collapse(const BinaryTree& tree, const Choices& choices, const WideCosts& costs,
                  base::Memory* memory);

} // namespace peregrine::accel::bvh
