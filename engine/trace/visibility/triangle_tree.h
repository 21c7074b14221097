#pragma once

#include "base/memory.h"
#include "math/box.h"

#include <array>
#include <cstdint>
#include <span>

// A binary tree over whole triangles, split at medians: small and quickly built. Proofs of
// visibility go through it twice, for what is seen and for what is in the way.
namespace peregrine::trace::visibility {

struct Corners {
    math::Vec3 v[3];
    bool masked;       // may be absent in places
    bool single_sided; // nobody sees what its back receives
};

// A triangle as proofs look at it again and again.
struct TreeTriangle {
    math::Vec3d v[3];
    math::Vec3d normal; // unit; zero of a sliver, which has none to speak of
    uint32_t index;     // in the list that the tree was built from
    bool masked;

    TreeTriangle(const Corners& corners, uint32_t index);
};

struct TriangleNode {
    math::Box box;
    uint32_t first; // a leaf's first triangle, or the first of two children
    uint32_t count; // triangles of a leaf; 0: an inner node

    bool is_leaf() const { return count != 0; }
};

struct TriangleTree {
    static constexpr uint32_t kLeafSize = 4;

    // Node 0 is the root; none without triangles. `triangles` must outlive the tree.
    TriangleTree(std::span<const Corners> triangles, base::Memory* memory);

    std::span<const Corners> triangles;
    base::Vector<TriangleNode> nodes;
    base::Vector<TreeTriangle> ordered; // leaf by leaf
};

} // namespace peregrine::trace::visibility
