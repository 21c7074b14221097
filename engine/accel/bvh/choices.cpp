#include "accel/bvh/choices.h"

#include "accel/bvh/object_split.h"

namespace peregrine::accel::bvh {
namespace {

constexpr float kNodePenalty = float(sizeof(Node)) / float(sizeof(Block));

// Costs of forests: lane k of `few` is for k + 1 roots, that of `many` for k + 5.
struct Costs {
    Floats few;
    Floats many; // the last one is of no use
};

Costs load(const float* cost) {
    Costs costs;
    std::memcpy(&costs, cost, sizeof costs);
    return costs;
}

// The least that two subtrees cost together with one root more than the lane says.
Costs least_sums(const Costs& left, const Costs& right) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr Floats kNone = {kInfinity, kInfinity, kInfinity, kInfinity};
    // By how many roots the left one has beyond the first, the right one's lanes shifted.
    const Floats few1 = __builtin_shufflevector(kNone, right.few, 0, 4, 5, 6);
    const Floats few2 = __builtin_shufflevector(kNone, right.few, 0, 1, 4, 5);
    const Floats few3 = __builtin_shufflevector(kNone, right.few, 0, 1, 2, 4);
    const Floats many1 = __builtin_shufflevector(right.few, right.many, 3, 4, 5, 6);
    const Floats many2 = __builtin_shufflevector(right.few, right.many, 2, 3, 4, 5);
    const Floats many3 = __builtin_shufflevector(right.few, right.many, 1, 2, 3, 4);
    const Floats& l = left.few;
    return {min(min(l[0] + right.few, l[1] + few1), min(l[2] + few2, l[3] + few3)),
            min(min(min(l[0] + right.many, l[1] + many1), min(l[2] + many2, l[3] + many3)),
                min(min(left.many[0] + right.few, left.many[1] + few1), left.many[2] + few2))};
}

} // namespace

Choices::Choices(const BinaryTree& tree, const WideCosts& costs, base::Memory* memory)
    : tree_(tree), costs_(costs), entries_(memory) {
    entries_.allocate(tree.nodes.size());
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
    entry.bias = 0x40;
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
    const Costs sums = least_sums(load(left.cost), load(right.cost));
    const float as_leaf = leaf_cost(a, entry.references);
    const float as_node = a * costs_.traversal + costs_.block_penalty * kNodePenalty + sums.many[2];
    entry.leaf = as_leaf <= as_node;
    float cost = std::min(as_leaf, as_node);
    for (uint32_t roots = 1; roots < kWidth; ++roots) {
        entry.cost[roots - 1] = cost;
        cost = std::min(cost, roots < 5 ? sums.few[roots - 1] : sums.many[roots - 5]);
    }
}

float Choices::leaf_cost(float area, uint32_t references) const {
    if (references > kMaxLeaf) return std::numeric_limits<float>::infinity();
    return (area * costs_.intersection + costs_.block_penalty)
           * float((references + kBlockWidth - 1) / kBlockWidth);
}

} // namespace peregrine::accel::bvh
