#include "accel/bvh/subtree.h"

#include "accel/bvh/effort.h"
#include "accel/bvh/treelet.h"

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

// More bins take a large node hardly longer.
constexpr uint32_t kManyReferences = 1024;
constexpr uint32_t kFewReferences = 48;

uint32_t bins_for(const Task& task, uint32_t references) {
    if (references <= kFewReferences) return task.effort.bins / 2;
    if (references <= kManyReferences) return task.effort.bins;
    return std::min(kMaxBins, references <= 16 * kManyReferences ? 2 * task.effort.bins
                                                                 : 4 * task.effort.bins);
}

bool wants_spatial_split(const Task& task, const Range& range, const Split& split) {
    if (task.effort.spatial_bins == 0 || range.spare() * 32 < range.size()) return false;
    if (!split.found()) return false; // triangles on top of each other
    const Bounds& own = range.extent.bounds;
    const float overlap = half_area(split.common * task.root_scale);
    return overlap > task.least_overlap
           && overlap > kOverlapOfNode * half_area((own.upper - own.lower) * task.root_scale);
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
    if (range.depth + levels_for(range.size()) >= task.depth_limit)
        return halve(arena, range, left, right);
    const std::span<const Reference> references(arena.data() + range.begin, range.size());
    const uint32_t bins = bins_for(task, range.size());
    const Split split = find_split(references, range.extent, bins);
    if (wants_spatial_split(task, range, split)) {
        const SpatialSplit spatial =
            find_spatial_split(task.triangles, references, range.extent.bounds,
                               range.size() > kManyReferences ? 2 * task.effort.spatial_bins
                                                              : task.effort.spatial_bins,
                               range.spare());
        if (spatial.cost < split.cost
            && partition(task.triangles, arena, range, spatial, left, right))
            return;
    }
    if (split.found())
        partition(arena, range, split, bins, left, right);
    else
        halve(arena, range, left, right);
}

void build_subtree(const Task& task, Arena& arena, const Range& range,
                   base::Vector<BinaryNode>& nodes) {
    if (range.size() <= task.effort.treelet && range.depth + range.size() <= task.depth_limit + 1)
        return build_treelet({arena.data() + range.begin, range.size()},
                             {task.effort.binary_leaf, range.begin}, nodes);
    const uint32_t node = add_node(nodes, range);
    if (range.size() <= task.effort.binary_leaf) return;
    if (range.size() >= kReferencesToAsk && task.control.cancelled()) return;
    Range left, right;
    split_range(task, arena, range, left, right);
    nodes[node].first = uint32_t(nodes.size());
    build_subtree(task, arena, left, nodes);
    nodes[node].second = uint32_t(nodes.size());
    build_subtree(task, arena, right, nodes);
}

} // namespace peregrine::accel::bvh
