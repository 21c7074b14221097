#pragma once

#include "accel/kdtree/partition.h"
#include "accel/kdtree/place.h"
#include "accel/kdtree/root.h"
#include "accel/kdtree/statistics.h"
#include "accel/kdtree/task.h"
#include "base/scheduler.h"

#include <cstdint>

namespace peregrine::accel::kdtree {

// Inner nodes have children side by side in the list of top nodes; the others are the roots of
// subtrees, still with their lists.
struct TopNode {
    TopNode(base::Memory* memory, const Place& node_place) : place(node_place), lists(memory) {}

    bool is_inner() const { return left_child != 0; }

    Place place;
    Split split;
    uint32_t left_child = 0;
    OwnedLists lists;
};

// Splits the largest nodes level by level, with the axes of all nodes of a level in parallel, until
// the rest is many subtrees that are independent of each other. A thread per node alone would leave
// most threads without work at the levels where the nodes are few and large. How far this goes
// depends on the number of triangles only, and so does the sum of rounded costs.
class TopLevels {
public:
    TopLevels(const Task& task, base::Scheduler& scheduler)
        : task_(task), scheduler_(scheduler), nodes_(task.memory), level_(task.memory),
          costs_(task.memory), partitions_(task.memory) {}

    // Of what build has done when this has: the rest is subtrees.
    static constexpr float kShareOfTime = 0.25f;

    base::Vector<TopNode> build(OwnedLists root, const math::Box& bounds);

private:
    void find_costs();
    void locate_splits();
    void drop_leaves();
    void begin_partitions();
    void run_partitions();
    void clip_straddlers();
    void add_children(uint32_t item, base::Vector<uint32_t>& next);
    void add_to_level(uint32_t node, base::Vector<uint32_t>& level) const;
    float progress() const;

    const Task& task_;
    base::Scheduler& scheduler_;
    uint32_t triangles_ = 0;
    uint32_t subtree_size_ = 0; // or smaller
    base::Vector<TopNode> nodes_;
    base::Vector<uint32_t> level_; // nodes that may be split
    base::Vector<double> costs_;   // three for each of them
    base::Vector<Partition> partitions_;
};

} // namespace peregrine::accel::kdtree
