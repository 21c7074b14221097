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

void make_children(std::span<Reference> all, const Range& range, uint32_t middle, Range& left,
                   Range& right) {
    left.begin = range.begin;
    left.end = right.begin = middle;
    right.end = range.end;
    left.depth = right.depth = range.depth + 1;
    left.extent = extent_of(all.subspan(left.begin, left.size()));
    right.extent = extent_of(all.subspan(right.begin, right.size()));
}

// Halves of equally many, whatever it costs: for triangles that no plane separates, and for trees
// that have grown deep.
uint32_t halve(std::span<Reference> all, const Range& range) {
    const Floats size = range.extent.centers.upper - range.extent.centers.lower;
    int axis = size[1] > size[0] ? 1 : 0;
    if (size[2] > size[axis]) axis = 2;
    const uint32_t middle =
        range.begin + (range.size() / 2 + kBlockWidth - 1) / kBlockWidth * kBlockWidth;
    std::nth_element(all.begin() + range.begin, all.begin() + middle, all.begin() + range.end,
                     [axis](const Reference& a, const Reference& b) {
                         const float at = a.lower[axis] + a.upper[axis];
                         const float bt = b.lower[axis] + b.upper[axis];
                         return at != bt ? at < bt : a.biased_triangle < b.biased_triangle;
                     });
    return middle;
}

uint32_t add_node(base::Vector<BinaryNode>& nodes, const Range& range) {
    BinaryNode& node = nodes.emplace_back();
    node.set_bounds(range.extent.bounds);
    node.first = range.begin;
    node.second = BinaryNode::kLeaf | range.size();
    return uint32_t(nodes.size() - 1);
}

} // namespace

void split_range(const Task& task, std::span<Reference> all, const Range& range, Range& left,
                 Range& right) {
    const std::span<Reference> own = all.subspan(range.begin, range.size());
    if (range.depth + levels_for(range.size()) < kMaxBinaryDepth) {
        const Split split = find_split(own, range.extent, task.bins);
        if (split.found()) {
            const BinMapping mapping(range.extent.centers, task.bins);
            const auto middle =
                std::partition(own.begin(), own.end(), [&](const Reference& reference) {
                    return mapping(reference.doubled_center())[int(split.axis)] < int(split.bin);
                });
            return make_children(all, range, range.begin + uint32_t(middle - own.begin()), left,
                                 right);
        }
    }
    make_children(all, range, halve(all, range), left, right);
}

void build_subtree(const Task& task, std::span<Reference> all, const Range& range,
                   base::Vector<BinaryNode>& nodes) {
    const uint32_t node = add_node(nodes, range);
    if (range.size() <= kBinaryLeaf) return;
    if (range.size() >= kReferencesToAsk && task.control.cancelled()) return;
    Range left, right;
    split_range(task, all, range, left, right);
    nodes[node].first = uint32_t(nodes.size());
    build_subtree(task, all, left, nodes);
    nodes[node].second = uint32_t(nodes.size());
    build_subtree(task, all, right, nodes);
}

} // namespace peregrine::accel::bvh
