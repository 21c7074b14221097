#include "accel/bvh/subtree.h"

#include <algorithm>
#include <bit>

namespace peregrine::accel::bvh {
namespace {

// Smaller ranges do not ask whether the build was cancelled.
constexpr uint32_t kReferencesToAsk = 4096;

// Levels that halving needs.
uint32_t levels_for(uint32_t references) {
    return uint32_t(std::bit_width(references - 1));
}

uint32_t add_node(base::Vector<BinaryNode>& nodes, const Range& range) {
    BinaryNode& node = nodes.emplace_back();
    node.set_bounds(range.extent.bounds);
    node.first = range.begin;
    node.second = BinaryNode::kLeaf | range.size();
    return uint32_t(nodes.size() - 1);
}

} // namespace

void split_range(const Task& task, Arena& arena, const Range& range, Range& left, Range& right) {
    if (range.depth + levels_for(range.size()) >= kMaxBinaryDepth)
        return halve(arena, range, left, right);
    const std::span<const Reference> references(arena.data() + range.begin, range.size());
    const Split split = find_split(references, range.extent, task.effort.bins);
    if (range.spare() > 0 && task.effort.spatial_bins > 0
        && (!split.found() || task.overlaps(split.common))) {
        const SpatialSplit spatial =
            find_spatial_split(task.triangles, references, range.extent.bounds,
                               task.effort.spatial_bins, range.spare());
        if (spatial.cost < split.cost
            && partition(task.triangles, arena, range, spatial, left, right))
            return;
    }
    if (split.found())
        partition(arena, range, split, task.effort.bins, left, right);
    else
        halve(arena, range, left, right);
}

void build_subtree(const Task& task, Arena& arena, const Range& range,
                   base::Vector<BinaryNode>& nodes) {
    const uint32_t node = add_node(nodes, range);
    if (range.size() <= kBinaryLeaf) return;
    if (range.size() >= kReferencesToAsk && task.control.cancelled()) return;
    Range left, right;
    split_range(task, arena, range, left, right);
    nodes[node].first = uint32_t(nodes.size());
    build_subtree(task, arena, left, nodes);
    nodes[node].second = uint32_t(nodes.size());
    build_subtree(task, arena, right, nodes);
}

} // namespace peregrine::accel::bvh
