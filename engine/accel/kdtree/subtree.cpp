#include "accel/kdtree/subtree.h"

#include <algorithm>
#include <utility>

namespace peregrine::accel::kdtree {
namespace {

// Smaller nodes do not ask whether the build was cancelled.
constexpr uint32_t kTrianglesToAsk = 4096;

} // namespace

void SubtreeBuilder::build(OwnedLists lists, const Place& place, Subtree& result) {
    nodes_.clear();
    references_.clear();
    statistics_ = {};
    Range range{};
    load(std::move(lists), range);
    nodes_.emplace_back();
    build_node(range, place, 0);
    result.nodes.assign(nodes_.begin(), nodes_.end());
    result.references.assign(references_.begin(), references_.end());
    result.statistics = statistics_;
}

void SubtreeBuilder::load(OwnedLists lists, Range& range) {
    for (uint32_t axis = 0; axis < 3; ++axis) {
        range.count[axis] = lists.count[axis];
        events_[axis].grow(range.count[axis], 0);
        std::copy_n(lists.events[axis].data(), range.count[axis], events_[axis].data());
    }
    range.triangles = lists.triangles;
    ids_.grow(range.triangles, 0);
    std::copy_n(lists.ids.data(), range.triangles, ids_.data());
}

// Recurses to the left and goes on to the right, so that nodes come out depth-first.
void SubtreeBuilder::build_node(Range range, Place place, uint32_t node) {
    for (;;) {
        if (range.triangles >= kTrianglesToAsk && task_.control.cancelled()) return;
        if (range.triangles <= SmallNode::kCapacity)
            return build_small_node(small_node(range), place, node);
        if (place.depth == task_.depth_limit) break;
        const Split split = best_split(range, place.cell);
        if (!task_.worth_it(split.cost, place.cell, range.triangles)) break;
        const double growth = place.growth_after(range.triangles, split.left, split.right);
        if (growth < 1) break;

        const uint32_t pair = add_inner(split.axis, split.position, place, node);
        const Place left = place.left(split.axis, split.position, growth);
        const Place right = place.right(split.axis, split.position, growth);
        const bool go_left = split.right == 0;
        if (split.left == 0)
            make_empty_leaf(left, pair);
        else if (split.right == 0)
            make_empty_leaf(right, pair + 1);
        else
            build_node(split_lists(range, place.cell, split), left, pair);
        place = go_left ? left : right;
        node = go_left ? pair : pair + 1;
    }
    make_leaf(ids_.data() + range.ids, range.triangles, place, node);
}

void SubtreeBuilder::build_small_node(SmallNode triangles, Place place, uint32_t node) {
    while (triangles.count > 0 && place.depth < task_.depth_limit) {
        const double limit = task_.model.leaf(place.cell, triangles.count);
        const SmallSplit split = find_small_split(triangles, place.cell, task_.model, limit);
        if (split.cost >= limit) break;
        const double growth = place.growth_after(triangles.count, split.left, split.right);
        if (growth < 1) break;

        const uint32_t pair = add_inner(split.axis, split.position, place, node);
        SmallNode left;
        split_small_node(triangles, task_.triangles, place.cell, split, left, triangles);
        build_small_node(left, place.left(split.axis, split.position, growth), pair);
        place = place.right(split.axis, split.position, growth);
        node = pair + 1;
    }
    make_leaf(triangles.ids, triangles.count, place, node);
}

SmallNode SubtreeBuilder::small_node(const Range& range) const {
    SmallNode node;
    node.count = range.triangles;
    std::copy_n(ids_.data() + range.ids, range.triangles, node.ids);
    for (uint32_t axis = 0; axis < 3; ++axis) {
        for (const Event event : events_of(range, axis)) {
            if (type(event) != kEnd) node.lower[axis][index(event)] = position(event);
            if (type(event) != kStart) node.upper[axis][index(event)] = position(event);
        }
    }
    return node;
}

Split SubtreeBuilder::best_split(const Range& range, const math::Box& cell) const {
    double costs[3];
    for (uint32_t axis = 0; axis < 3; ++axis)
        costs[axis] =
            cheapest_plane(events_of(range, axis), range.triangles, cell, axis, task_.model);
    const uint32_t axis = uint32_t(std::min_element(costs, costs + 3) - costs);
    if (!task_.worth_it(costs[axis], cell, range.triangles)) return {};
    return locate_plane(events_of(range, axis), range.triangles, cell, axis, task_.model,
                        costs[axis]);
}

// Returns the left child's lists; `range` becomes the right one's.
SubtreeBuilder::Range SubtreeBuilder::split_lists(Range& range, const math::Box& cell,
                                                  const Split& split) {
    Range left{};
    const Lists parent = lists_at(range);
    for (uint32_t axis = 0; axis < 3; ++axis) {
        left.events[axis] = range.events[axis] + range.count[axis];
        events_[axis].grow(left.events[axis] + Partition::events_to_move(split, parent, axis, true),
                           left.events[axis]);
    }
    left.ids = range.ids + range.triangles;
    ids_.grow(left.ids + Partition::ids_to_move(split, true), left.ids);

    partition_.begin(task_.triangles, cell, split, true, lists_at(range), lists_at(left));
    partition_.classify();
    for (uint32_t axis = 0; axis < 3; ++axis) partition_.separate(axis);
    if (partition_.straddlers() > 0) {
        partition_.clip(0, partition_.straddlers());
        partition_.place_straddlers();
        for (uint32_t axis = 0; axis < 3; ++axis) {
            partition_.merge(axis, false);
            partition_.merge(axis, true);
        }
    }
    const auto shrink = [](Range& child, const Lists& lists) {
        std::copy_n(lists.count, 3, child.count);
        child.triangles = lists.triangles;
    };
    shrink(range, partition_.stayed());
    shrink(left, partition_.moved());
    return left;
}

// Returns the first of its two children.
uint32_t SubtreeBuilder::add_inner(uint32_t axis, float position, const Place& place,
                                   uint32_t node) {
    if (nodes_.size() + 2 > kMaxNodes) fail_for_nodes();
    const uint32_t pair = uint32_t(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node] = Node::inner(axis, position, pair);
    statistics_.add_inner(task_.model, place.cell);
    return pair;
}

void SubtreeBuilder::make_leaf(const uint32_t* ids, uint32_t count, const Place& place,
                               uint32_t node) {
    statistics_.add_leaf(task_.model, place.cell, place.depth, count);
    const size_t first = count > 0 ? references_.size() : 0;
    nodes_[node] = Node::leaf(uint32_t(first), count);
    references_.insert(references_.end(), ids, ids + count);
    if (count > 1) std::sort(references_.begin() + std::ptrdiff_t(first), references_.end());
}

Lists SubtreeBuilder::lists_at(const Range& range) {
    Lists lists{};
    for (uint32_t axis = 0; axis < 3; ++axis) {
        lists.events[axis] = events_[axis].data() + range.events[axis];
        lists.count[axis] = range.count[axis];
    }
    lists.ids = ids_.data() + range.ids;
    lists.triangles = range.triangles;
    return lists;
}

} // namespace peregrine::accel::kdtree
