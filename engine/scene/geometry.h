#pragma once

#include "accel/bih/tree.h"
#include "accel/bvh/compact_tree.h"
#include "accel/bvh/tree.h"
#include "accel/kdtree/tree.h"
#include "base/memory.h"
#include "geometry/triangle.h"
#include "trace/bih/target.h"
#include "trace/bvh/target.h"
#include "trace/kdtree/target.h"
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

    bool is_compact() const { return !compact_bvh.nodes.empty(); }

    trace::Target target() const {
        switch (structure) {
        case trace::Structure::kdtree:
            return trace::kdtree::target_of(infos.data(), triangles.data(), bounds(), kdtree);
        case trace::Structure::bih:
            return trace::bih::target_of(infos.data(), triangles.data(), bounds(), bih);
        default:
            return is_compact() ? trace::bvh::target_of(infos.data(), bounds(), compact_bvh)
                                : trace::bvh::target_of(infos.data(), bounds(), bvh);
        }
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
