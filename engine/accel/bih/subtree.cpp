#include "accel/bih/subtree.h"

#include "accel/bih/cut.h"
#include "accel/bih/split.h"

#include <algorithm>

namespace peregrine::accel::bih {
namespace {

// Smaller ranges do not ask whether the build was cancelled.
constexpr uint32_t kReferencesToAsk = 4096;

// Recursive, kMaxDepth deep at most.
void build_node(const Task& task, Subtree& subtree, Range range, uint32_t slot) {
    if (range.size() >= kReferencesToAsk && task.control.cancelled()) return;
    Node* const nodes = subtree.nodes;
    Statistics& statistics = subtree.statistics;
    for (Node node; subtree.cuts < subtree.range.size() && cut(task, range, subtree.count, node);
         slot = node.child()) {
        statistics.cost += double(task.costs.traversal_cost) * half_area(range.cell);
        nodes[slot] = node;
        ++subtree.cuts;
        ++subtree.count;
    }
    Halves halves;
    if (!split(task, range, halves)) {
        nodes[slot] = Node::leaf(range.begin, range.size());
        statistics.cost +=
            double(task.costs.intersection_cost) * range.size() * half_area(range.cell);
        statistics.max_depth = std::max(statistics.max_depth, range.depth);
        statistics.largest_leaf = std::max<uint64_t>(statistics.largest_leaf, range.size());
        ++statistics.leaves;
        return;
    }
    statistics.cost += double(task.costs.traversal_cost) * half_area(range.cell);
    const uint32_t left = subtree.count;
    subtree.count += 2;
    nodes[slot] = halves.node(left);
    build_node(task, subtree, halves.left, left);
    build_node(task, subtree, halves.right, left + 1);
}

} // namespace

void Statistics::add(const Statistics& other) {
    cost += other.cost;
    max_depth = std::max(max_depth, other.max_depth);
    leaves += other.leaves;
    largest_leaf = std::max(largest_leaf, other.largest_leaf);
}

void build_subtree(const Task& task, Subtree& subtree) {
    subtree.nodes = task.nodes + size_t(kNodesPerTriangle) * subtree.range.begin;
    subtree.count = 1;
    build_node(task, subtree, subtree.range, 0);
}

} // namespace peregrine::accel::bih
