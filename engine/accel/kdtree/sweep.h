#pragma once

#include "accel/kdtree/cost.h"
#include "accel/kdtree/event.h"

#include <cstdint>
#include <limits>
#include <span>

namespace peregrine::accel::kdtree {

struct Split {
    double cost = std::numeric_limits<double>::infinity();
    float position = 0;
    uint32_t axis = 0;
    uint32_t boundary = 0; // events of `axis` before it belong to the left child
    uint32_t left = 0;     // triangles; straddlers count on both sides
    uint32_t right = 0;
};

// The cost of the best plane strictly inside the cell and perpendicular to `axis`, or infinity.
double cheapest_plane(std::span<const Event> events, uint32_t triangles, const math::Box& cell,
                      uint32_t axis, const CostModel& model);

// The first plane of that cost.
Split locate_plane(std::span<const Event> events, uint32_t triangles, const math::Box& cell,
                   uint32_t axis, const CostModel& model, double cost);

} // namespace peregrine::accel::kdtree
