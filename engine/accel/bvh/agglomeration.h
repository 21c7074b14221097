#pragma once

#include "accel/bvh/binary_tree.h"
#include "accel/bvh/task.h"
#include "accel/morton_order.h"

namespace peregrine::accel::bvh {

// Of joining, and so levels of binary nodes.
inline constexpr uint32_t kMaxRounds = 20;

// Subtrees over neighbours along a Morton curve.
struct Clusters {
    explicit Clusters(base::Memory* memory) : nodes(memory), roots(memory) {}

    base::Vector<BinaryNode> nodes; // leaves' references are members
    base::Vector<Reference> roots;  // by their nodes and how many triangles they have
};

// Triangles leaf by leaf, copied so that they are read one after the other.
struct Members {
    explicit Members(base::Memory* memory) : triangles(memory), numbers(memory) {}

    Buffer<geometry::Triangle> triangles;
    Buffer<uint32_t> numbers; // in the list that was built from
};

// Joins neighbours along the curve that are each other's better one, round by round: the search of
// Meister and Bittner 2018, "Parallel Locally-Ordered Clustering for Bounding Volume Hierarchy
// Construction", reaching no farther than the next item. What is large stays alone. `bounds` are
// those of all triangles.
base::Vector<Clusters> agglomerate(const Task& task, std::span<const MortonKey> keys,
                                   const Bounds& bounds, base::Scheduler& scheduler,
                                   Members& members);

} // namespace peregrine::accel::bvh
