#include "accel/bvh/choices.h"

#include "accel/bvh/object_split.h"

namespace peregrine::accel::bvh {
namespace {

constexpr float kNodePenalty = float(sizeof(Node)) / float(sizeof(Block));

} // namespace

Choices::Choices(const BinaryTree& tree, const WideCosts& costs, base::Memory* memory)
    : tree_(tree), costs_(costs), entries_(tree.nodes.size(), memory) {
    const Bounds root = tree.nodes[0].bounds();
    scale_ = scale_of(root);
    const float area = half_area((root.upper - root.lower) * scale_);
    inverse_area_ = area > 0 ? 1 / area : 0;
}

void Choices::compute(base::Scheduler& scheduler) {
    scheduler.for_each(uint32_t(tree_.parts.size()), [&](uint32_t i) {
        const BinaryTree::Part part = tree_.parts[i];
        for (uint32_t node = part.end; node-- > part.begin;) decide(node);
    });
    for (uint32_t node = tree_.top(); node-- > 0;) decide(node);
}

void Choices::decide(uint32_t index) {
    const BinaryNode& node = tree_.nodes[index];
    Entry& entry = entries_[index];
    const float a = area(index);
    if (node.is_leaf()) {
        entry.references = uint8_t(std::min(node.count(), kMany));
        entry.height = 0;
        entry.leaf = true;
        std::fill_n(entry.cost, kWidth - 1, leaf_cost(a, entry.references));
        return;
    }
    const Entry& left = entries_[node.first];
    const Entry& right = entries_[node.second];
    entry.references = uint8_t(std::min(uint32_t(left.references) + right.references, kMany));
    entry.height = uint8_t(1 + std::max(left.height, right.height));
    const float as_leaf = leaf_cost(a, entry.references);
    const float as_node = a * costs_.traversal + costs_.block_penalty * kNodePenalty
                          + distribute(left, right, kWidth).cost;
    entry.leaf = as_leaf <= as_node;
    entry.cost[0] = std::min(as_leaf, as_node);
    for (uint32_t roots = 2; roots < kWidth; ++roots)
        entry.cost[roots - 1] =
            std::min(distribute(left, right, roots).cost, entry.cost[roots - 2]);
}

float Choices::leaf_cost(float area, uint32_t references) const {
    if (references > kMaxLeaf) return std::numeric_limits<float>::infinity();
    return (area * costs_.intersection + costs_.block_penalty)
           * float((references + kBlockWidth - 1) / kBlockWidth);
}

} // namespace peregrine::accel::bvh
