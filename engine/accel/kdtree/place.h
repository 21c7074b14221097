#pragma once

#include "math/box.h"

#include <cstdint>

namespace peregrine::accel::kdtree {

// The greedy heuristic happily splits large or long triangles that cross each other into hundreds
// of references each. So a node may have this many times more references below it than triangles,
// and hands that on to its children in proportion to theirs: a bound on the whole tree's memory.
inline constexpr double kMaxGrowth = 64;

// A node's place in space and in the tree.
struct Place {
    math::Box cell;
    uint32_t depth = 0;
    double growth_left = kMaxGrowth;

    Place left(uint32_t axis, float position, double growth) const {
        Place child{cell, depth + 1, growth};
        child.cell.upper[int(axis)] = position;
        return child;
    }
    Place right(uint32_t axis, float position, double growth) const {
        Place child{cell, depth + 1, growth};
        child.cell.lower[int(axis)] = position;
        return child;
    }

    // What a split leaves of it; below 1 the node must be a leaf.
    double growth_after(uint32_t triangles, uint32_t left, uint32_t right) const {
        return growth_left * triangles / (double(left) + double(right));
    }
};

} // namespace peregrine::accel::kdtree
