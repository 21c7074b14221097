#include "accel/bvh/collapse.h"

#include "base/error.h"

#include <utility>

namespace peregrine::accel::bvh {
namespace {

constexpr uint32_t kLevels = 3; // of binary nodes that fit in a wide one
static_assert(1u << kLevels == kWidth);

class Collapse {
public:
    Collapse(const BinaryTree& tree, const Choices& choices, const WideCosts& costs,
             base::Memory* memory)
        : nodes_(tree.nodes), choices_(choices), costs_(costs), wide_(memory) {}

    WideTree run() {
        add(0, 1);
        return std::move(wide_);
    }

private:
    // Returns the wide node's number; `depth` counts it.
    uint32_t add(uint32_t binary, uint32_t depth) {
        WideNode wide{};
        choose_children(binary, kMaxDepth - depth, wide);
        wide_.depth = std::max(wide_.depth, depth);
        wide_.cost += double(choices_.area(binary)) * double(costs_.traversal);
        for (uint32_t i = 0; i < wide.count; ++i)
            if (choices_.is_leaf(wide.children[i])) wide.targets[i] = add_leaf(wide.children[i]);
        const uint32_t number = uint32_t(wide_.nodes.size());
        wide_.nodes.push_back(wide);
        for (uint32_t i = 0; i < wide.count; ++i) {
            if (choices_.is_leaf(wide.children[i])) continue;
            const uint32_t child = add(wide.children[i], depth + 1);
            wide_.nodes[number].targets[i] = child;
        }
        return number;
    }

    uint32_t add_leaf(uint32_t binary) {
        const uint32_t references = choices_.references(binary);
        const uint32_t blocks = (references + kBlockWidth - 1) / kBlockWidth;
        const uint32_t target = Link::kLeaf | wide_.references;
        wide_.references += references;
        wide_.blocks += blocks;
        wide_.cost += double(choices_.area(binary)) * double(costs_.intersection) * blocks;
        return target;
    }

    void choose_children(uint32_t binary, uint32_t levels_below, WideNode& wide) const {
        if (choices_.is_leaf(binary)) { // the root alone
            wide.children[wide.count++] = binary;
            return;
        }
        open(binary, kWidth, wide);
        if (fits(wide, levels_below)) return;
        wide.count = 0;
        open_levels(binary, kLevels, wide);
        if (!fits(wide, levels_below)) base::fail(base::Code::internal, "a BVH is too deep");
    }

    // Whether the subtrees are low enough, opened by whole levels if need be.
    bool fits(const WideNode& wide, uint32_t levels) const {
        for (uint32_t i = 0; i < wide.count; ++i)
            if (!choices_.is_leaf(wide.children[i])
                && choices_.height(wide.children[i]) > kLevels * levels)
                return false;
        return true;
    }

    void gather(uint32_t binary, uint32_t most_roots, WideNode& wide) const {
        const uint32_t roots = choices_.fewest_roots(binary, most_roots);
        if (roots == 1)
            wide.children[wide.count++] = binary;
        else
            open(binary, roots, wide);
    }
    void open(uint32_t binary, uint32_t roots, WideNode& wide) const {
        const uint32_t left = choices_.distribute(binary, roots).left;
        gather(nodes_[binary].first, left, wide);
        gather(nodes_[binary].second, roots - left, wide);
    }
    void open_levels(uint32_t binary, uint32_t levels, WideNode& wide) const {
        if (levels == 0 || choices_.is_leaf(binary)) {
            wide.children[wide.count++] = binary;
            return;
        }
        open_levels(nodes_[binary].first, levels - 1, wide);
        open_levels(nodes_[binary].second, levels - 1, wide);
    }

    const base::Vector<BinaryNode>& nodes_;
    const Choices& choices_;
    WideCosts costs_;
    WideTree wide_;
};

} // namespace

WideTree collapse(const BinaryTree& tree, const Choices& choices, const WideCosts& costs,
                  base::Memory* memory) {
    return Collapse(tree, choices, costs, memory).run();
}

} // namespace peregrine::accel::bvh
