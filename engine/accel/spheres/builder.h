#pragma once

#include "accel/spheres/tree.h"
#include "base/memory.h"
#include "base/scheduler.h"

#include <span>

namespace peregrine::accel::spheres {

// Builds the tree over the spheres, of which sphere i belongs to item items[i]. All must be within
// the limits of tree.h.
void build(std::span<const Sphere> spheres, std::span<const uint32_t> items,
           base::Scheduler& scheduler, base::Memory* memory, Tree& out);

} // namespace peregrine::accel::spheres
