#pragma once

#include "accel/bih/task.h"

namespace peregrine::accel::bih {

// What a tree's report is made of. Costs are half areas times costs.
struct Statistics {
    double cost = 0;
    uint32_t max_depth = 0;
    uint64_t leaves = 0;
    uint64_t largest_leaf = 0;

    void add(const Statistics& other);
};

// What one thread builds.
struct Subtree {
    uint32_t slot; // of its root among the top nodes
    Range range;
    Node* nodes = nullptr; // with links within
    uint32_t count = 0;
    uint32_t cuts = 0;
    Statistics statistics = {};
};

// Incomplete if cancelled.
void build_subtree(const Task& task, Subtree& subtree);

} // namespace peregrine::accel::bih
