#pragma once

#include "accel/bvh/tree.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "geometry/triangle.h"

#include <span>

namespace peregrine::accel::bvh {

enum class Quality : uint32_t { balanced = 0, fast = 1, best = 2 };

struct BuildOptions {
    Quality quality = Quality::balanced;
    float traversal_cost = 1.0f;    // of a node, ...
    float intersection_cost = 1.0f; // ... of a block of triangles
};

// The tree depends on the triangles and the options alone, not on the number of threads. Throws
// std::bad_alloc, or base::Error cancelled or limit.
Tree build(std::span<const geometry::Triangle> triangles, const BuildOptions& options,
           base::Scheduler& scheduler, const base::Progress& progress, base::Memory* memory);

} // namespace peregrine::accel::bvh
