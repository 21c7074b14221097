#pragma once

#include "accel/bih/subtree.h"
#include "base/scheduler.h"

namespace peregrine::accel::bih {

// Of the time that a build takes, about.
inline constexpr float kShareOfTop = 0.4f;

// Splits level by level until ranges are small enough for one thread each. These depend on the
// triangles alone, not on the number of threads. Incomplete if cancelled.
void build_top(const Task& task, const Range& root, base::Scheduler& scheduler,
               base::Vector<Node>& nodes, base::Vector<Subtree>& subtrees, Statistics& statistics);

} // namespace peregrine::accel::bih
