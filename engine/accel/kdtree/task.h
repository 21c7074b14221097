#pragma once

#include "accel/control.h"
#include "accel/kdtree/cost.h"
#include "base/memory.h"
#include "geometry/triangle.h"

#include <cstdint>

namespace peregrine::accel::kdtree {

inline constexpr uint64_t kMaxTriangles = uint64_t(1) << 27;
inline constexpr uint64_t kMaxNodes = uint64_t(1) << 29;

// What all parts of one build share.
struct Task {
    const geometry::Triangle* triangles;
    CostModel model;
    uint32_t depth_limit;
    Control& control;
    base::Memory* memory;

    bool worth_it(double cost, const math::Box& cell, uint32_t count) const {
        return cost < model.leaf(cell, count);
    }
};

[[noreturn]] inline void fail_for_nodes() {
    base::fail(base::Code::limit, "the kd-tree would have more than %llu nodes",
               static_cast<unsigned long long>(kMaxNodes));
}

} // namespace peregrine::accel::kdtree
