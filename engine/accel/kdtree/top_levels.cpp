#include "accel/kdtree/top_levels.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace peregrine::accel::kdtree {
namespace {

constexpr uint32_t kSubtreesWanted = 256;
constexpr uint32_t kMinSubtreeSize = 1024;
constexpr uint32_t kStraddlersPerTask = 1024;

bool left_moves(const Split& split) {
    return split.left < split.right;
}
bool cuts_off_empty_space(const Split& split) {
    return split.left == 0 || split.right == 0;
}

double growth_after(const TopNode& node) {
    return node.place.growth_after(node.lists.triangles, node.split.left, node.split.right);
}

} // namespace

base::Vector<TopNode> TopLevels::build(OwnedLists root, const math::Box& bounds) {
    subtree_size_ = std::max(kMinSubtreeSize, root.triangles / kSubtreesWanted);
    triangles_ = root.triangles;
    nodes_.emplace_back(task_.memory, Place{bounds});
    nodes_[0].lists = std::move(root);
    add_to_level(0, level_);
    while (!level_.empty()) {
        if (task_.control.report(progress())) break;
        find_costs();
        locate_splits();
        drop_leaves();
        begin_partitions();
        run_partitions();
        base::Vector<uint32_t> next(task_.memory);
        for (uint32_t i = 0; i < level_.size(); ++i) add_children(i, next);
        level_ = std::move(next);
    }
    return std::move(nodes_);
}

void TopLevels::add_to_level(uint32_t node, base::Vector<uint32_t>& level) const {
    if (nodes_[node].lists.triangles > subtree_size_
        && nodes_[node].place.depth < task_.depth_limit)
        level.push_back(node);
}

void TopLevels::find_costs() {
    costs_.resize(3 * level_.size());
    scheduler_.for_each(uint32_t(costs_.size()), [&](uint32_t i) {
        const uint32_t axis = i % 3;
        const TopNode& node = nodes_[level_[i / 3]];
        costs_[i] = cheapest_plane(node.lists.events_of(axis), node.lists.triangles,
                                   node.place.cell, axis, task_.model);
    });
}

void TopLevels::locate_splits() {
    scheduler_.for_each(uint32_t(level_.size()), [&](uint32_t i) {
        TopNode& node = nodes_[level_[i]];
        const double* costs = costs_.data() + 3 * i;
        const uint32_t axis = uint32_t(std::min_element(costs, costs + 3) - costs);
        if (task_.worth_it(costs[axis], node.place.cell, node.lists.triangles))
            node.split = locate_plane(node.lists.events_of(axis), node.lists.triangles,
                                      node.place.cell, axis, task_.model, costs[axis]);
    });
}

// What must not be split becomes a subtree, which comes to the same conclusion.
void TopLevels::drop_leaves() {
    std::erase_if(level_, [&](uint32_t index) {
        const TopNode& node = nodes_[index];
        return !task_.worth_it(node.split.cost, node.place.cell, node.lists.triangles)
               || growth_after(node) < 1;
    });
}

void TopLevels::begin_partitions() {
    nodes_.reserve(nodes_.size() + 2 * level_.size());
    while (partitions_.size() < level_.size()) partitions_.emplace_back(task_.memory);
    for (uint32_t i = 0; i < level_.size(); ++i) {
        TopNode& node = nodes_[level_[i]];
        const double growth = growth_after(node);
        node.left_child = uint32_t(nodes_.size());
        nodes_.emplace_back(task_.memory,
                            node.place.left(node.split.axis, node.split.position, growth));
        nodes_.emplace_back(task_.memory,
                            node.place.right(node.split.axis, node.split.position, growth));
        if (cuts_off_empty_space(node.split)) continue;
        const bool left = left_moves(node.split);
        OwnedLists& moved = nodes_[node.left_child + !left].lists;
        const Lists lists = node.lists.view();
        for (uint32_t axis = 0; axis < 3; ++axis)
            moved.events[axis].allocate(Partition::events_to_move(node.split, lists, axis, left));
        moved.ids.allocate(Partition::ids_to_move(node.split, left));
        partitions_[i].begin(task_.triangles, node.place.cell, node.split, left, lists,
                             moved.view());
    }
}

void TopLevels::run_partitions() {
    const uint32_t count = uint32_t(level_.size());
    const auto active = [&](uint32_t i) { return !cuts_off_empty_space(nodes_[level_[i]].split); };
    scheduler_.for_each(count, [&](uint32_t i) {
        if (active(i)) partitions_[i].classify();
    });
    scheduler_.for_each(3 * count, [&](uint32_t i) {
        if (active(i / 3)) partitions_[i / 3].separate(i % 3);
    });
    clip_straddlers();
    scheduler_.for_each(count, [&](uint32_t i) {
        if (active(i)) partitions_[i].place_straddlers();
    });
    scheduler_.for_each(6 * count, [&](uint32_t i) {
        if (active(i / 6)) partitions_[i / 6].merge(i % 3, i % 6 >= 3);
    });
}

void TopLevels::clip_straddlers() {
    struct Chunk {
        uint32_t item, first, last;
    };
    base::Vector<Chunk> chunks(task_.memory);
    for (uint32_t i = 0; i < level_.size(); ++i) {
        if (cuts_off_empty_space(nodes_[level_[i]].split)) continue;
        const uint32_t count = partitions_[i].straddlers();
        for (uint32_t first = 0; first < count; first += kStraddlersPerTask)
            chunks.push_back({i, first, std::min(count, first + kStraddlersPerTask)});
    }
    scheduler_.for_each(uint32_t(chunks.size()), [&](uint32_t i) {
        partitions_[chunks[i].item].clip(chunks[i].first, chunks[i].last);
    });
}

void TopLevels::add_children(uint32_t item, base::Vector<uint32_t>& next) {
    TopNode& node = nodes_[level_[item]];
    const bool left = left_moves(node.split); // the empty one, if one is
    OwnedLists& moved = nodes_[node.left_child + !left].lists;
    OwnedLists& stayed = nodes_[node.left_child + left].lists;
    if (!cuts_off_empty_space(node.split)) {
        node.lists.resize(partitions_[item].stayed());
        moved.resize(partitions_[item].moved());
    }
    stayed = std::move(node.lists);
    add_to_level(node.left_child, next);
    add_to_level(node.left_child + 1, next);
}

// Nodes shrink by some factor from level to level.
float TopLevels::progress() const {
    uint32_t largest = subtree_size_;
    for (uint32_t node : level_) largest = std::max(largest, nodes_[node].lists.triangles);
    const float levels = std::log2(float(triangles_) / float(subtree_size_));
    const float levels_left = std::log2(float(largest) / float(subtree_size_));
    return kShareOfTime * (1 - levels_left / levels);
}

} // namespace peregrine::accel::kdtree
