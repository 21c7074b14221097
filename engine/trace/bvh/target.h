#pragma once

#include "accel/bvh/compact_tree.h"
#include "accel/bvh/tree.h"
#include "trace/kernels.h"

namespace peregrine::trace::bvh {

// Either the full tree or the compact one.
struct TreeView {
    const accel::bvh::Node* nodes;
    const accel::bvh::Block* blocks;
    const accel::bvh::CompactNode* compact_nodes;
    const accel::bvh::LeafUnit* compact_leaves;

    bool is_compact() const { return compact_nodes != nullptr; }
};

inline const TreeView& tree_of(const Target& target) {
    return target.view<TreeView>();
}

inline Target target_of(const geometry::TriangleInfo* infos, const math::Box& bounds,
                        const accel::bvh::Tree& tree) {
    return {infos, bounds, TreeView{tree.nodes.data(), tree.blocks.data(), nullptr, nullptr}};
}
inline Target target_of(const geometry::TriangleInfo* infos, const math::Box& bounds,
                        const accel::bvh::CompactTree& tree) {
    return {infos, bounds, TreeView{nullptr, nullptr, tree.nodes.data(), tree.leaves.data()}};
}

} // namespace peregrine::trace::bvh
