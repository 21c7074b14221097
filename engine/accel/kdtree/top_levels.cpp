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
bool cuts_off_nothing(const Split& split) {
    return split.left == 0 || split.right == 0;
}

} // namespace

base::Vector<TopNode> TopLevels::build(OwnedLists root, const math::Box& bounds) {
    subtree_size_ = std::max(kMinSubtreeSize, root.triangles / kSubtreesWanted);
    triangles_ = root.triangles;
    nodes_.emplace_back(task_.memory, bounds, 0u);
    nodes_[0].lists = std::move(root);
    add_to_level(0, level_);
    while (!level_.empty()) {
        if (task_.control.report(progress())) break;
        find_splits();
        drop_leaves();
        locate_splits();
        begin_partitions();
        run_partitions();
        base::Vector<uint32_t> next(task_.memory);
        for (uint32_t i = 0; i < level_.size(); ++i) add_children(i, next);
        level_ = std::move(next);
    }
    return std::move(nodes_);
}

void TopLevels::add_to_level(uint32_t node, base::Vector<uint32_t>& level) const {
    if (nodes_[node].lists.triangles > subtree_size_ && nodes_[node].depth < task_.depth_limit)
        level.push_back(node);
}

void TopLevels::find_splits() {
    costs_.resize(3 * level_.size());
    scheduler_.for_each(uint32_t(costs_.size()), [&](uint32_t i) {
        const uint32_t axis = i % 3;
        const TopNode& node = nodes_[level_[i / 3]];
        costs_[i] = cheapest_plane(node.lists.events_of(axis), node.lists.triangles, node.cell,
                                   axis, task_.model);
    });
}

// What is not worth a split becomes a subtree, which comes to the same conclusion.
void TopLevels::drop_leaves() {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < level_.size(); ++i) {
        TopNode& node = nodes_[level_[i]];
        const double* costs = costs_.data() + 3 * i;
        node.split.axis = uint32_t(std::min_element(costs, costs + 3) - costs);
        node.split.cost = costs[node.split.axis];
        if (task_.worth_it(node.split.cost, node.cell, node.lists.triangles))
            level_[kept++] = level_[i];
    }
    level_.resize(kept);
}

void TopLevels::locate_splits() {
    scheduler_.for_each(uint32_t(level_.size()), [&](uint32_t i) {
        TopNode& node = nodes_[level_[i]];
        node.split = locate_plane(node.lists.events_of(node.split.axis), node.lists.triangles,
                                  node.cell, node.split.axis, task_.model, node.split.cost);
    });
}

void TopLevels::begin_partitions() {
    nodes_.reserve(nodes_.size() + 2 * level_.size());
    while (partitions_.size() < level_.size()) partitions_.emplace_back(task_.memory);
    for (uint32_t i = 0; i < level_.size(); ++i) {
        TopNode& node = nodes_[level_[i]];
        node.left_child = uint32_t(nodes_.size());
        nodes_.emplace_back(task_.memory,
                            left_cell(node.cell, node.split.axis, node.split.position),
                            node.depth + 1);
        nodes_.emplace_back(task_.memory,
                            right_cell(node.cell, node.split.axis, node.split.position),
                            node.depth + 1);
        if (cuts_off_nothing(node.split)) continue;
        const bool left = left_moves(node.split);
        OwnedLists& moved = nodes_[node.left_child + !left].lists;
        const Lists lists = node.lists.view();
        for (uint32_t axis = 0; axis < 3; ++axis)
            moved.events[axis].allocate(Partition::events_to_move(node.split, lists, axis, left));
        moved.ids.allocate(Partition::ids_to_move(node.split, left));
        partitions_[i].begin(task_.triangles, node.cell, node.split, left, lists, moved.view());
    }
}

void TopLevels::run_partitions() {
    const uint32_t count = uint32_t(level_.size());
    const auto active = [&](uint32_t i) { return !cuts_off_nothing(nodes_[level_[i]].split); };
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
        if (cuts_off_nothing(nodes_[level_[i]].split)) continue;
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
    if (!cuts_off_nothing(node.split)) {
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
