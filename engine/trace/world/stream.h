#pragma once

#include "trace/world/world.h"

// Streams through all parts of a world: the fixed part takes them as they are, each moving part the
// rays that may meet it. The positions are those of the rays' origins.
namespace peregrine::trace {

inline constexpr uint32_t kMaxStream = 1024; // rays, in a world that moves

void closest_of_moving(const World& world, const RayStream& rays, const Positions& positions,
                       const Filter& filter, const HitStream& hits);
void occluded_by_moving(const World& world, const RayStream& rays, const Positions& positions,
                        const Filter& filter, uint8_t* occluded);

inline void closest(const World& world, const RayStream& rays, const Positions& positions,
                    const Filter& filter, const HitStream& hits) {
    world.fixed.kernels->closest_stream(world.fixed.target, rays, filter, hits);
    if (world.nodes) closest_of_moving(world, rays, positions, filter, hits);
}

inline void occluded(const World& world, const RayStream& rays, const Positions& positions,
                     const Filter& filter, uint8_t* occluded) {
    world.fixed.kernels->occluded_stream(world.fixed.target, rays, filter, occluded);
    if (world.nodes) occluded_by_moving(world, rays, positions, filter, occluded);
}

} // namespace peregrine::trace
