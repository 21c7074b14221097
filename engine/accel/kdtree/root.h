#pragma once

#include "accel/kdtree/lists.h"
#include "base/memory.h"
#include "base/scheduler.h"
#include "geometry/triangle.h"
#include "math/box.h"

#include <cstdint>
#include <span>

namespace peregrine::accel::kdtree {

// The sorted events of all triangles and their bounds.
void make_root(std::span<const geometry::Triangle> triangles, base::Scheduler& scheduler,
               base::Memory* memory, OwnedLists& lists, math::Box& bounds);

} // namespace peregrine::accel::kdtree
