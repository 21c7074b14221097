#include "accel/bih/top_levels.h"

#include "accel/bih/cut.h"
#include "accel/bih/split.h"

#include <algorithm>
#include <utility>

namespace peregrine::accel::bih {
namespace {

constexpr uint32_t kSubtreesWanted = 64;
constexpr uint32_t kMinSubtreeSize = 1024;
static_assert(kMinSubtreeSize > kMaxLeaf, "no leaf among the top nodes");

struct Item {
    uint32_t slot;
    Range range;
    Halves halves;
};

} // namespace

void build_top(const Task& task, const Range& root, base::Scheduler& scheduler,
               base::Vector<Node>& nodes, base::Vector<Subtree>& subtrees, Statistics& statistics) {
    const uint32_t subtree_size = std::max(kMinSubtreeSize, root.size() / kSubtreesWanted);
    const double traversal = double(task.costs.traversal_cost);
    // Room that hardly depends on where the triangles are, so that builds use it again.
    const size_t usual = size_t(2) * (root.size() / subtree_size + 1);
    base::Vector<Item> level(task.memory), next(task.memory);
    level.reserve(usual);
    next.reserve(usual);
    subtrees.reserve(usual);
    nodes.reserve(size_t(2) * root.size());
    const auto add = [&](uint32_t slot, Range range, base::Vector<Item>& to) {
        if (range.size() <= subtree_size) {
            subtrees.push_back({slot, range});
            return;
        }
        for (Node node; cut(task, range, uint32_t(nodes.size()), node); slot = node.child()) {
            statistics.cost += traversal * half_area(range.cell);
            nodes[slot] = node;
            nodes.emplace_back();
        }
        to.push_back({slot, range, {}});
    };
    nodes.emplace_back();
    add(0, root, level);
    for (uint32_t depth = 1; !level.empty(); ++depth) {
        if (task.control.report(kShareOfTop * (1 - 1 / float(depth)))) return;
        scheduler.for_each(uint32_t(level.size()),
                           [&](uint32_t i) { split(task, level[i].range, level[i].halves); });
        next.clear();
        for (const Item& item : level) {
            const uint32_t left = uint32_t(nodes.size());
            nodes.resize(left + 2);
            nodes[item.slot] = item.halves.node(left);
            statistics.cost += traversal * half_area(item.range.cell);
            add(left, item.halves.left, next);
            add(left + 1, item.halves.right, next);
        }
        std::swap(level, next);
    }
}

} // namespace peregrine::accel::bih
