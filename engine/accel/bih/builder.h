#pragma once

#include "accel/bih/tree.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "geometry/triangle.h"

#include <span>

namespace peregrine::accel::bih {

struct BuildOptions {
    float traversal_cost = 1.0f;    // of a node, ...
    float intersection_cost = 1.0f; // ... of a triangle
    bool fast = false; // sorts once, along a curve through space, and asks no costs where to split
};

// The bounding interval hierarchy of Waechter and Keller (EGSR 2006): objects are sorted in place,
// none is cut. The planes come from a binned SAH over the cells that a ray will see rather than
// from their global heuristic. The tree depends on the triangles and the options alone, not
// on the number of threads. Throws std::bad_alloc, or base::Error cancelled or limit.
Tree build(std::span<const geometry::Triangle> triangles, const BuildOptions& options,
           base::Scheduler& scheduler, const base::Progress& progress, base::Memory* memory);

} // namespace peregrine::accel::bih
