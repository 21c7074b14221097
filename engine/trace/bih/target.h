#pragma once

#include "accel/bih/tree.h"
#include "geometry/triangle.h"
#include "trace/kernels.h"
#include "trace/reference_lists.h"

namespace peregrine::trace::bih {

struct TreeView {
    const accel::bih::Node* nodes;
    ReferenceLists lists;
};

inline const TreeView& tree_of(const Target& target) {
    return target.view<TreeView>();
}

inline Target target_of(const geometry::TriangleInfo* infos, const geometry::Triangle* triangles,
                        const math::Box& bounds, const accel::bih::Tree& tree) {
    return {infos, bounds, TreeView{tree.nodes.data(), {tree.references.data(), triangles}}};
}

} // namespace peregrine::trace::bih
