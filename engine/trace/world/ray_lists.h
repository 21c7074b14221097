#pragma once

#include "accel/instances/rest.h"
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
    alignas(64) float t_max[kRoom];   // where the best hit is so far; below t_min: nothing is left
    alignas(64) float rest[3][kRoom]; // of the origin, for nodes that have one, too
};

// One ray. Where its numbers could leave float's normal range, it enters everything.
struct GateRay {
    float origin[3];
    float inverse[3];
    float distance; // |origin|_inf
    float t_min;
    bool is_usual;
    float rest[3]; // of the origin, for nodes that have one, too
};

// The children of a node that something enters, as bits, and when.
struct EnteredNode {
    uint32_t children;
    alignas(32) float t_near[accel::instances::kWidth];
};

// Lists of rays, by number in the stream; with room for 16 more.
using RayNumber = uint16_t;

// A child of a node with what its floats have left.
struct FarExtent {
    accel::instances::Extent rounded;
    math::Vec3 lower, upper;
    float margin;
};

inline FarExtent far_extent(const accel::instances::Node& node,
                            const accel::instances::NodeRest& rest, uint32_t i) {
    return {node.extent(i),
            {rest.lower[0][i], rest.lower[1][i], rest.lower[2][i]},
            {rest.upper[0][i], rest.upper[1][i], rest.upper[2][i]},
            rest.margin[i]};
}

// Compiled for each instruction set.
struct RayLists {
    // All but t_max and the rests.
    void (*look_at)(const RayStream& rays, GateStream& gate);
    // Rays 0 to count - 1 that may meet the extent, into `to`; returns how many.
    uint32_t (*enter_all)(const accel::instances::Extent& extent, const GateStream& rays,
                          uint32_t count, RayNumber* to);
    // Those of `from` that may meet the extent; returns how many. `to` may be `from`.
    uint32_t (*enter)(const accel::instances::Extent& extent, const GateStream& rays,
                      const RayNumber* from, uint32_t count, RayNumber* to);
    // All of a ray but the rest, and which children of the first node it may meet.
    void (*enter_root)(const accel::instances::Node& root, const math::Ray& ray, GateRay& gate,
                       EnteredNode& entered);
    // The children that the ray may meet up to t_max.
    void (*enter_node)(const accel::instances::Node& node, const GateRay& ray, float t_max,
                       EnteredNode& entered);

    // The same of nodes that have rests.
    uint32_t (*enter_all_far)(const FarExtent& extent, const GateStream& rays, uint32_t count,
                              RayNumber* to);
    uint32_t (*enter_far)(const FarExtent& extent, const GateStream& rays, const RayNumber* from,
                          uint32_t count, RayNumber* to);
    void (*enter_node_far)(const accel::instances::Node& node,
                           const accel::instances::NodeRest& rest, const GateRay& ray, float t_max,
                           EnteredNode& entered);
};

// For this instruction set, or the plain one if it was not compiled. Does not ask the machine.
const RayLists& ray_lists(base::Isa isa);

} // namespace peregrine::trace
