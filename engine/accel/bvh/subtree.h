#pragma once

#include "accel/bvh/binary_tree.h"
#include "accel/bvh/split.h"
#include "accel/bvh/task.h"

#include <span>

namespace peregrine::accel::bvh {

// A node yet to be built over references [begin, end).
struct Range {
    uint32_t begin;
    uint32_t end;
    uint32_t depth; // of binary nodes
    Extent extent;

    uint32_t size() const { return end - begin; }
};

// Splits a range, whose references it sorts into the two sides. Both have some.
void split_range(const Task& task, std::span<Reference> all, const Range& range, Range& left,
                 Range& right);

// Adds the subtree's nodes, with indices within `nodes`. Incomplete if cancelled.
void build_subtree(const Task& task, std::span<Reference> all, const Range& range,
                   base::Vector<BinaryNode>& nodes);

} // namespace peregrine::accel::bvh
