#pragma once

#include "accel/bvh/agglomeration.h"

namespace peregrine::accel::bvh {

// The heuristic over clusters takes a fraction of its time over triangles: the hybrid of Pantaleoni
// and Luebke 2010, with clusters that are better than runs of a Morton curve.
BinaryTree build_cluster_tree(Task& task, std::span<const geometry::Triangle> triangles,
                              base::Scheduler& scheduler, Members& members);

} // namespace peregrine::accel::bvh
