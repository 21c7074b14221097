#pragma once

#include "accel/bih/builder.h"
#include "accel/control.h"
#include "accel/reference.h"

#include <bit>
#include <cstdint>

namespace peregrine::accel::bih {

inline constexpr uint64_t kMaxTriangles = uint64_t(1) << 27;

// More are split whatever it costs, even if they all lie at one place.
inline constexpr uint32_t kMaxLeaf = 8;

// Inner nodes and leaves are fewer than two, and a subtree has at most one cut for each.
inline constexpr uint32_t kNodesPerTriangle = 3;

// What all parts of one build share.
struct Task {
    Reference* references; // sorted in place
    const Bounds* blocks;  // null, or they were sorted along a curve, once for all (morton.h)
    Node* nodes;           // room for those of subtrees
    BuildOptions costs;
    Control& control;
    base::Memory* memory;
};

// A node yet to be built over references [begin, end), which lie in the cell that rays are cut to.
struct Range {
    uint32_t begin;
    uint32_t end;
    uint32_t depth; // inner nodes above
    Bounds cell;
    Extent extent;

    uint32_t size() const { return end - begin; }
};

// In double: the sides may be 1e30.
inline double half_area(const Bounds& bounds) {
    return math::half_area(bounds.box());
}

} // namespace peregrine::accel::bih
