#pragma once

#include "accel/kdtree/partition.h"
#include "accel/kdtree/place.h"
#include "accel/kdtree/small_node.h"
#include "accel/kdtree/statistics.h"
#include "accel/kdtree/task.h"
#include "accel/kdtree/tree.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace peregrine::accel::kdtree {

// Numbers nodes and references from 0: the root, then pairs of siblings in depth-first order.
struct Subtree {
    explicit Subtree(base::Memory* memory) : nodes(memory), references(memory) {}

    base::Vector<Node> nodes;
    base::Vector<uint32_t> references;
    Statistics statistics;
};

// Builds one subtree after another on one thread, all in the same memory: a node's lists lie on a
// stack, the right child's in place of its parent's, the left child's on top.
class SubtreeBuilder {
public:
    explicit SubtreeBuilder(const Task& task)
        : task_(task), partition_(task.memory),
          events_{Buffer<Event>(task.memory), Buffer<Event>(task.memory),
                  Buffer<Event>(task.memory)},
          ids_(task.memory), nodes_(task.memory), references_(task.memory) {}

    // Incomplete if the build was cancelled.
    void build(OwnedLists lists, const Place& place, Subtree& result);

private:
    // Where lists are on the stacks.
    struct Range {
        size_t events[3];
        uint32_t count[3];
        size_t ids;
        uint32_t triangles;
    };

    void build_node(Range range, Place place, uint32_t node);
    void build_small_node(SmallNode triangles, Place place, uint32_t node);
    SmallNode small_node(const Range& range) const;
    Split best_split(const Range& range, const math::Box& cell) const;
    Range split_lists(Range& range, const math::Box& cell, const Split& split);
    uint32_t add_inner(uint32_t axis, float position, const Place& place, uint32_t node);
    void make_leaf(const uint32_t* ids, uint32_t count, const Place& place, uint32_t node);
    void make_empty_leaf(const Place& place, uint32_t node) { make_leaf(nullptr, 0, place, node); }
    void load(OwnedLists lists, Range& range);
    Lists lists_at(const Range& range);
    std::span<const Event> events_of(const Range& range, uint32_t axis) const {
        return {events_[axis].data() + range.events[axis], range.count[axis]};
    }

    const Task& task_;
    Partition partition_;
    Buffer<Event> events_[3];
    Buffer<uint32_t> ids_;
    base::Vector<Node> nodes_;
    base::Vector<uint32_t> references_;
    Statistics statistics_;
};

} // namespace peregrine::accel::kdtree
