#include "accel/bvh/top_down.h"

#include "accel/bvh/subtree.h"
#include "accel/bvh/top_levels.h"
#include "accel/subtrees.h"

namespace peregrine::accel::bvh {
namespace {

void build_subtrees(const Task& task, Arena& arena, base::Vector<Subtree>& subtrees,
                    base::Scheduler& scheduler) {
    accel::build_subtrees(
        uint32_t(subtrees.size()), [&](uint32_t i) { return subtrees[i].range.size(); },
        [&](uint32_t i) { build_subtree(task, arena, subtrees[i].range, subtrees[i].nodes); },
        kShareOfTop, task.control, scheduler, task.memory);
}

// A subtree's root goes where the top nodes have room for it, the rest to the end.
void join(base::Vector<Subtree>& subtrees, BinaryTree& tree) {
    size_t total = tree.nodes.size();
    for (const Subtree& subtree : subtrees) total += subtree.nodes.size() - 1;
    tree.nodes.reserve(total);
    for (Subtree& subtree : subtrees) {
        const uint32_t begin = uint32_t(tree.nodes.size());
        for (BinaryNode& node : subtree.nodes) {
            if (node.is_leaf()) continue;
            node.first += begin - 1;
            node.second += begin - 1;
        }
        tree.nodes[subtree.node] = subtree.nodes[0];
        tree.nodes.insert(tree.nodes.end(), subtree.nodes.begin() + 1, subtree.nodes.end());
        tree.parts.push_back({begin, uint32_t(tree.nodes.size())});
        base::Vector<BinaryNode>(tree.nodes.get_allocator()).swap(subtree.nodes);
    }
}

} // namespace

BinaryTree build_top_down(const Task& task, Arena& arena, const Range& root,
                          base::Scheduler& scheduler) {
    BinaryTree tree(task.memory);
    base::Vector<Subtree> subtrees(task.memory);
    build_top(task, arena, root, scheduler, tree.nodes, subtrees);
    task.control.throw_if_cancelled();
    build_subtrees(task, arena, subtrees, scheduler);
    join(subtrees, tree);
    return tree;
}

} // namespace peregrine::accel::bvh
