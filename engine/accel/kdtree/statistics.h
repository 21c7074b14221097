#pragma once

#include "accel/kdtree/cost.h"

#include <algorithm>
#include <cstdint>

namespace peregrine::accel::kdtree {

// What a build report is made of; sums up in any grouping that is always the same.
struct Statistics {
    double cost = 0; // of a ray through the whole space, times half areas
    uint32_t max_depth = 0;
    uint64_t leaves = 0;
    uint64_t empty_leaves = 0;
    uint64_t largest_leaf = 0;

    void add_inner(const CostModel& model, const math::Box& cell) {
        cost += model.traversal * math::half_area(cell);
    }

    void add_leaf(const CostModel& model, const math::Box& cell, uint32_t depth,
                  uint32_t triangles) {
        cost += model.leaf(cell, triangles);
        max_depth = std::max(max_depth, depth);
        ++leaves;
        empty_leaves += triangles == 0;
        largest_leaf = std::max<uint64_t>(largest_leaf, triangles);
    }

    void add(const Statistics& other) {
        cost += other.cost;
        max_depth = std::max(max_depth, other.max_depth);
        leaves += other.leaves;
        empty_leaves += other.empty_leaves;
        largest_leaf = std::max(largest_leaf, other.largest_leaf);
    }
};

} // namespace peregrine::accel::kdtree
