#pragma once

#include "accel/buffer.h"
#include "accel/bvh/object_split.h"
#include "accel/bvh/task.h"
#include "base/scheduler.h"

namespace peregrine::accel::bvh {

inline constexpr uint32_t kMaxCluster = 16; // references
static_assert(kMaxCluster <= kClusterDepth);

// Groups of neighbouring references. Each is given as a reference of its own, whose number is that
// of its first member and whose weight is how many it has.
struct Clusters {
    explicit Clusters(base::Memory* memory) : members(memory), groups(memory) {}

    Buffer<Reference> members; // sorted along a Morton curve
    base::Vector<Reference> groups;
};

// The heuristic over clusters takes a fraction of its time over triangles: a simple form of the
// hybrid of Pantaleoni and Luebke 2010.
void make_clusters(const Task& task, const Reference* references, uint32_t count,
                   const Extent& extent, base::Scheduler& scheduler, Clusters& clusters);

} // namespace peregrine::accel::bvh
