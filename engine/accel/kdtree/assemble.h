#pragma once

#include "accel/kdtree/subtree.h"
#include "accel/kdtree/top_levels.h"
#include "base/scheduler.h"

#include <span>

namespace peregrine::accel::kdtree {

// Joins the top nodes and the subtrees, one for each top node that is not inner, to the nodes,
// references and statistics of one tree in depth-first order.
Statistics assemble(std::span<const TopNode> top, std::span<const Subtree> subtrees,
                    const CostModel& model, base::Scheduler& scheduler, Tree& tree);

} // namespace peregrine::accel::kdtree
