#pragma once

#include "accel/bih/tree.h"
#include "accel/bvh/compact_tree.h"
#include "accel/bvh/tree.h"
#include "accel/kdtree/tree.h"
#include "base/memory.h"
#include "geometry/triangle.h"
#include "trace/kernels.h"

#include <cstdint>

namespace peregrine::scene {

// Triangles and the structure over them; shared by snapshots between which they did not change.
struct Geometry {
    explicit Geometry(base::Memory* memory)
        : infos(memory), triangles(memory), bvh(memory), compact_bvh(memory), kdtree(memory),
          bih(memory) {}

    trace::Structure structure = trace::Structure::bvh;
    base::Vector<geometry::TriangleInfo> infos;
    base::Vector<geometry::Triangle> triangles; // empty once a BVH has its own copy
    accel::bvh::Tree bvh;
    accel::bvh::CompactTree compact_bvh; // has bvh's nodes and blocks if it has any
    accel::kdtree::Tree kdtree;
    accel::bih::Tree bih;
    uint64_t degenerate_count = 0;
    uint64_t non_finite_count = 0;

    trace::Target target() const {
        return {infos.data(),
                bounds(),
                bvh.nodes.data(),
                bvh.blocks.data(),
                kdtree.nodes.data(),
                kdtree.references.data(),
                triangles.data(),
                bih.nodes.data(),
                bih.references.data(),
                compact_bvh.nodes.data(),
                compact_bvh.leaves.data()};
    }

    const math::Box& bounds() const {
        switch (structure) {
        case trace::Structure::kdtree:
            return kdtree.bounds;
        case trace::Structure::bih:
            return bih.bounds;
        default:
            return bvh.bounds;
        }
    }
};

} // namespace peregrine::scene
