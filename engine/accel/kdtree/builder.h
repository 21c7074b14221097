#pragma once

#include "accel/kdtree/tree.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "geometry/triangle.h"

#include <span>

namespace peregrine::accel::kdtree {

struct BuildOptions {
    float traversal_cost = 1.0f;    // of a node, ...
    float intersection_cost = 2.0f; // ... of a triangle
    float empty_bonus = 0.0f;       // cost of a split that cuts off empty space: times 1 - this
};

// The greedy SAH kd-tree of Wald and Havran 2006: an O(N log N) event sweep over three axes with
// triangles clipped to their cells. The tree depends on the triangles and the options alone, not
// on the number of threads. Throws std::bad_alloc, or base::Error cancelled or limit.
Tree build(std::span<const geometry::Triangle> triangles, const BuildOptions& options,
           base::Scheduler& scheduler, const base::Progress& progress, base::Memory* memory);

} // namespace peregrine::accel::kdtree
