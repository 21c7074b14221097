#pragma once

#include "accel/kdtree/cost.h"
#include "geometry/triangle.h"

#include <cstdint>
#include <limits>

namespace peregrine::accel::kdtree {

// Of few triangles the bounds alone: it is cheaper to count them anew for each plane, many planes
// at a time, than to keep sorted events. The planes and their costs are those of the sweep.
struct SmallNode {
    static constexpr uint32_t kCapacity = 16;

    uint32_t count = 0;
    uint32_t ids[kCapacity];
    float lower[3][kCapacity];
    float upper[3][kCapacity];

    math::Box box(uint32_t i) const {
        return {{lower[0][i], lower[1][i], lower[2][i]}, {upper[0][i], upper[1][i], upper[2][i]}};
    }

    void add(uint32_t id, const math::Box& box) {
        ids[count] = id;
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis][count] = box.lower[axis];
            upper[axis][count] = box.upper[axis];
        }
        ++count;
    }
};

struct SmallSplit {
    double cost = std::numeric_limits<double>::infinity();
    float position = 0;
    uint32_t axis = 0;
    bool planar_left = false; // triangles in the plane go to the left child
    uint32_t left = 0;        // triangles; straddlers count on both sides
    uint32_t right = 0;
};

// `cost` is all that is set if the split costs `limit` or more.
SmallSplit find_small_split(const SmallNode& node, const math::Box& cell, const CostModel& model,
                            double limit);

// Straddlers are clipped. `right` may be `node`.
void split_small_node(const SmallNode& node, const geometry::Triangle* triangles,
                      const math::Box& cell, const SmallSplit& split, SmallNode& left,
                      SmallNode& right);

} // namespace peregrine::accel::kdtree
