#include "accel/bvh/collapse.h"

#include "base/error.h"

#include <algorithm>
#include <limits>

namespace peregrine::accel::bvh {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Of a subtree: cost[i] is the least for at most i + 1 roots (Ylitie et al. 2017, section 3.1, who
// call it C(n, i + 1)).
struct Choice {
    float cost[kWidth - 1];
    uint8_t references; // or 255, if there are more
    uint8_t height;
    uint16_t unused;

    float of(uint32_t roots) const { return cost[std::min(roots, kWidth - 1) - 1]; }
};

class Collapse {
public:
    Collapse(const Task& task, const base::Vector<BinaryNode>& nodes)
        : task_(task), nodes_(nodes), choices_(nodes.size(), task.memory), wide_(task.memory) {
        const double area = math::half_area(nodes[0].box());
        scale_ = area > 0 ? 1 / area : 0;
    }

    WideTree run() {
        for (uint32_t i = uint32_t(nodes_.size()); i-- > 0;) decide(i);
        wide_.cost = double(choices_[0].cost[0]);
        add_wide(0, 0);
        return std::move(wide_);
    }

private:
    float area(uint32_t node) const { return float(math::half_area(nodes_[node].box()) * scale_); }

    void decide(uint32_t index) {
        const BinaryNode& node = nodes_[index];
        Choice& choice = choices_[index];
        const float a = area(index);
        if (node.is_leaf()) {
            choice.references = uint8_t(std::min(node.count(), 255u));
            choice.height = 0;
            std::fill_n(choice.cost, kWidth - 1, leaf_cost(a, choice.references));
            return;
        }
        const Choice& left = choices_[node.first];
        const Choice& right = choices_[node.second];
        choice.references = uint8_t(std::min(left.references + right.references, 255));
        choice.height = uint8_t(1 + std::max(left.height, right.height));
        for (uint32_t roots = 2; roots < kWidth; ++roots)
            choice.cost[roots - 1] = distribute(left, right, roots).cost;
        choice.cost[0] =
            std::min(leaf_cost(a, choice.references),
                     a * task_.options.traversal_cost + distribute(left, right, kWidth).cost);
        for (uint32_t i = 1; i + 1 < kWidth; ++i)
            choice.cost[i] = std::min(choice.cost[i], choice.cost[i - 1]);
    }

    float leaf_cost(float a, uint32_t references) const {
        if (references > kMaxLeaf) return kInfinity;
        return a * task_.options.intersection_cost * float((references + 3) / 4);
    }

    struct Distribution {
        float cost;
        uint32_t left;
    };
    static Distribution distribute(const Choice& left, const Choice& right, uint32_t roots) {
        Distribution best{kInfinity, 1};
        for (uint32_t k = 1; k < roots; ++k) {
            const float cost = left.of(k) + right.of(roots - k);
            if (cost < best.cost) best = {cost, k};
        }
        return best;
    }

    bool becomes_leaf(uint32_t index) const {
        const Choice& choice = choices_[index];
        return nodes_[index].is_leaf()
               || (choice.references <= kMaxLeaf
                   && choice.cost[0] == leaf_cost(area(index), choice.references));
    }

    // The roots of what the forest of at most `roots` is.
    void gather(uint32_t index, uint32_t roots, WideNode& wide) const {
        const Choice& choice = choices_[index];
        while (roots > 1 && choice.cost[roots - 1] == choice.cost[roots - 2]) --roots;
        if (roots == 1) {
            wide.children[wide.count++] = index;
            return;
        }
        open(index, roots, wide);
    }
    void open(uint32_t index, uint32_t roots, WideNode& wide) const {
        const BinaryNode& node = nodes_[index];
        const Distribution best = distribute(choices_[node.first], choices_[node.second], roots);
        gather(node.first, best.left, wide);
        gather(node.second, roots - best.left, wide);
    }

    void open_levels(uint32_t index, uint32_t levels, WideNode& wide) const {
        if (levels == 0 || nodes_[index].is_leaf()) {
            wide.children[wide.count++] = index;
            return;
        }
        open_levels(nodes_[index].first, levels - 1, wide);
        open_levels(nodes_[index].second, levels - 1, wide);
    }

    bool fits(const WideNode& wide, uint32_t levels) const {
        for (uint32_t i = 0; i < wide.count; ++i)
            if (!becomes_leaf(wide.children[i]) && choices_[wide.children[i]].height > 3 * levels)
                return false;
        return true;
    }

    uint32_t add_wide(uint32_t index, uint32_t depth) {
        if (depth >= kMaxDepth) base::fail(base::Code::internal, "a BVH is too deep");
        WideNode wide{};
        if (becomes_leaf(index)) { // the root alone
            wide.children[wide.count++] = index;
        } else {
            open(index, kWidth, wide);
            if (!fits(wide, kMaxDepth - 1 - depth)) {
                wide.count = 0;
                open_levels(index, 3, wide);
            }
        }
        wide_.depth = std::max(wide_.depth, depth + 1);
        const uint32_t number = uint32_t(wide_.nodes.size());
        wide_.nodes.push_back(wide);
        for (uint32_t i = 0; i < wide.count; ++i) {
            const uint32_t child = wide.children[i];
            if (!becomes_leaf(child)) continue;
            const uint32_t references = choices_[child].references;
            wide_.nodes[number].links[i] = Link::leaf(uint32_t(wide_.blocks), references).bits;
            wide_.blocks += (references + 3) / 4;
        }
        for (uint32_t i = 0; i < wide.count; ++i) {
            const uint32_t child = wide.children[i];
            if (becomes_leaf(child)) continue;
            const uint32_t link = add_wide(child, depth + 1);
            wide_.nodes[number].links[i] = link;
        }
        return number;
    }

    const Task& task_;
    const base::Vector<BinaryNode>& nodes_;
    base::Vector<Choice> choices_;
    WideTree wide_;
    double scale_;
};

} // namespace

WideTree collapse(const Task& task, const base::Vector<BinaryNode>& nodes) {
    return Collapse(task, nodes).run();
}

} // namespace peregrine::accel::bvh
