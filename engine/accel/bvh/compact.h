#pragma once

#include "accel/bvh/compact_tree.h"
#include "base/scheduler.h"

namespace peregrine::accel::bvh {

// The same tree in fewer bytes. It depends on the tree alone, not on the number of threads. Throws
// std::bad_alloc, or base::Error limit.
CompactTree compact(const Tree& tree, base::Scheduler& scheduler, base::Memory* memory);

} // namespace peregrine::accel::bvh
