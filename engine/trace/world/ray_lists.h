#pragma once

#include "accel/instances/tree.h"
#include "base/isa.h"
#include "trace/kernels.h"

#include <cstdint>

namespace peregrine::trace {

// What the nodes over instances want to know of a stream's rays. A ray whose numbers could leave
// float's normal range has inverses of 0 and no end: it enters everything.
struct GateStream {
    static constexpr uint32_t kRoom = 1024 + 16;

    alignas(64) float origin[3][kRoom];
    alignas(64) float inverse[3][kRoom];
    alignas(64) float distance[kRoom]; // |origin|_inf
    alignas(64) float t_min[kRoom];
    alignas(64) float t_max[kRoom]; // where the best hit is so far; below t_min: nothing is left
};

// Lists of rays, by number in the stream; with room for 16 more.
using RayNumber = uint16_t;

// Compiled for each instruction set.
struct RayLists {
    // All but t_max.
    void (*look_at)(const RayStream& rays, GateStream& gate);
    // Rays 0 to count - 1 that may meet the extent, into `to`; returns how many.
    uint32_t (*enter_all)(const accel::instances::Extent& extent, const GateStream& rays,
                          uint32_t count, RayNumber* to);
    // Those of `from` that may meet the extent; returns how many. `to` may be `from`.
    uint32_t (*enter)(const accel::instances::Extent& extent, const GateStream& rays,
                      const RayNumber* from, uint32_t count, RayNumber* to);
};

// For this instruction set, or the plain one if it was not compiled. Does not ask the machine.
const RayLists& ray_lists(base::Isa isa);

} // namespace peregrine::trace
