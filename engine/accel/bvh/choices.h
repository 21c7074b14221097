#pragma once

#include "accel/buffer.h"
#include "accel/bvh/binary_tree.h"
#include "accel/bvh/task.h"

#include <algorithm>
#include <limits>

namespace peregrine::accel::bvh {

// What a ray costs that goes through the root's box. `block_penalty` is what a block costs by being
// there, and a node by as much more as it is larger: it keeps trees small where that is cheap.
struct WideCosts {
    float traversal;
    float intersection;
    float block_penalty;
};

// The cheapest ways to make a binary tree wide, for all subtrees at once, by the dynamic programme
// of Ylitie, Karras and Laine 2017, section 3.1, with leaves of several blocks.
class Choices {
public:
    Choices(const BinaryTree& tree, const WideCosts& costs, base::Memory* memory);

    void compute(base::Scheduler& scheduler);

    // How many roots either child gets if a subtree becomes a forest of at most `roots`.
    struct Distribution {
        float cost;
        uint32_t left;
    };
    Distribution distribute(uint32_t node, uint32_t roots) const {
        const BinaryNode& binary = tree_.nodes[node];
        return distribute(entries_[binary.first], entries_[binary.second], roots);
    }

    // The least number of roots that is as good as `roots`.
    uint32_t fewest_roots(uint32_t node, uint32_t roots) const {
        const float* cost = entries_[node].cost;
        while (roots > 1 && cost[roots - 1] == cost[roots - 2]) --roots;
        return roots;
    }

    bool is_leaf(uint32_t node) const { return entries_[node].leaf; }
    uint32_t references(uint32_t node) const { return entries_[node].references; }
    uint32_t height(uint32_t node) const { return entries_[node].height; }
    float area(uint32_t node) const {
        const BinaryNode& binary = tree_.nodes[node];
        const Bounds bounds = binary.bounds();
        return half_area((bounds.upper - bounds.lower) * scale_) * inverse_area_;
    }

private:
    // cost[i] is the least for a forest of at most i + 1 roots.
    struct Entry {
        float cost[kWidth - 1];
        uint8_t references; // or kMany
        uint8_t height;
        bool leaf;    // as one root
        uint8_t bias; // so that the last four bytes, read as a float, are not denormal
    };
    static_assert(sizeof(Entry) == 32);
    static constexpr uint32_t kMany = 255;

    static Distribution distribute(const Entry& left, const Entry& right, uint32_t roots) {
        Distribution best{std::numeric_limits<float>::infinity(), 1};
        for (uint32_t i = 1; i < roots; ++i) {
            const float cost = left.cost[i - 1] + right.cost[roots - i - 1];
            if (cost < best.cost) best = {cost, i};
        }
        return best;
    }

    void decide(uint32_t node);
    float leaf_cost(float area, uint32_t references) const;

    const BinaryTree& tree_;
    WideCosts costs_;
    float scale_;
    float inverse_area_;
    Buffer<Entry> entries_;
};

} // namespace peregrine::accel::bvh
