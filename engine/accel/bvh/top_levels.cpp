#include "accel/bvh/top_levels.h"

#include "accel/bvh/subtree.h"

#include <algorithm>
#include <utility>

namespace peregrine::accel::bvh {
namespace {

constexpr uint32_t kSubtreesWanted = 64;

struct Item {
    uint32_t node;
    Range range;
    Range children[2];
};

} // namespace

void build_top(const Task& task, Arena& arena, const Range& root, base::Scheduler& scheduler,
               base::Vector<BinaryNode>& nodes, base::Vector<Subtree>& subtrees) {
    const uint32_t subtree_size = std::max(task.effort.subtree, root.size() / kSubtreesWanted);
    base::Vector<Item> level(task.memory);
    const auto add = [&](uint32_t node, const Range& range, base::Vector<Item>& to) {
        if (range.size() > subtree_size)
            to.push_back({node, range, {}});
        else
            subtrees.emplace_back(node, range, task.memory);
    };
    nodes.emplace_back();
    add(0, root, level);
    for (uint32_t depth = 1; !level.empty(); ++depth) {
        if (task.control.report(kShareOfTop * (1 - 1 / float(depth)))) return;
        scheduler.for_each(uint32_t(level.size()), [&](uint32_t i) {
            split_range(task, arena, level[i].range, level[i].children[0], level[i].children[1]);
        });
        base::Vector<Item> next(task.memory);
        for (const Item& item : level) {
            const uint32_t left = uint32_t(nodes.size());
            nodes.resize(nodes.size() + 2);
            nodes[item.node].set_bounds(item.range.extent.bounds);
            nodes[item.node].first = left;
            nodes[item.node].second = left + 1;
            add(left, item.children[0], next);
            add(left + 1, item.children[1], next);
        }
        level = std::move(next);
    }
}

} // namespace peregrine::accel::bvh
