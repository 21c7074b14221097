#include "accel/kdtree/assemble.h"

#include <limits>

namespace peregrine::accel::kdtree {
namespace {

// Where a subtree goes: its root apart, the rest in one piece.
struct Placement {
    const Subtree* subtree;
    uint32_t root;
    uint32_t first_node; // of the others
    uint32_t first_reference;
};

class Layout {
public:
    Layout(std::span<const TopNode> top, std::span<const Subtree> subtrees, const CostModel& model,
           Tree& tree, base::Vector<Placement>& placements)
        : top_(top), subtrees_(subtrees), model_(model), tree_(tree), placements_(placements) {}

    void place(uint32_t index, uint32_t slot) {
        const TopNode& node = top_[index];
        if (!node.is_inner()) return place_subtree(subtrees_[index], slot);
        const uint32_t pair = next_node_;
        next_node_ += 2;
        tree_.nodes[slot] = Node::inner(node.split.axis, node.split.position, pair);
        statistics_.add_inner(model_, node.place.cell);
        place(node.left_child, pair);
        place(node.left_child + 1, pair + 1);
    }

    const Statistics& statistics() const { return statistics_; }

private:
    void place_subtree(const Subtree& subtree, uint32_t slot) {
        placements_.push_back({&subtree, slot, next_node_, next_reference_});
        next_node_ += uint32_t(subtree.nodes.size() - 1);
        next_reference_ += uint32_t(subtree.references.size());
        statistics_.add(subtree.statistics);
    }

    std::span<const TopNode> top_;
    std::span<const Subtree> subtrees_;
    const CostModel& model_;
    Tree& tree_;
    base::Vector<Placement>& placements_;
    uint32_t next_node_ = 1;
    uint32_t next_reference_ = 0;
    Statistics statistics_;
};

Node relocated(Node node, const Placement& to) {
    if (!node.is_leaf())
        node.link += (to.first_node - 1) << 2;
    else if (node.reference_count() > 0)
        node.first_reference += to.first_reference;
    return node;
}

void copy(const Placement& to, Tree& tree) {
    const Subtree& from = *to.subtree;
    tree.nodes[to.root] = relocated(from.nodes[0], to);
    for (size_t i = 1; i < from.nodes.size(); ++i)
        tree.nodes[to.first_node + i - 1] = relocated(from.nodes[i], to);
    std::copy(from.references.begin(), from.references.end(),
              tree.references.begin() + to.first_reference);
}

void make_room(std::span<const TopNode> top, std::span<const Subtree> subtrees, Tree& tree) {
    uint64_t nodes = 0;
    uint64_t references = 0;
    for (size_t i = 0; i < top.size(); ++i) {
        nodes += top[i].is_inner() ? 1 : subtrees[i].nodes.size();
        references += subtrees[i].references.size();
    }
    if (nodes > kMaxNodes) fail_for_nodes();
    if (references > std::numeric_limits<uint32_t>::max())
        base::fail(base::Code::limit, "the kd-tree would have more than 2^32 - 1 references");
    tree.nodes.resize(nodes);
    tree.references.resize(references);
}

} // namespace

Statistics assemble(std::span<const TopNode> top, std::span<const Subtree> subtrees,
                    const CostModel& model, base::Scheduler& scheduler, Tree& tree) {
    make_room(top, subtrees, tree);
    base::Vector<Placement> placements(tree.nodes.get_allocator().resource());
    Layout layout(top, subtrees, model, tree, placements);
    layout.place(0, 0);
    scheduler.for_each(uint32_t(placements.size()), [&](uint32_t i) { copy(placements[i], tree); });
    return layout.statistics();
}

} // namespace peregrine::accel::kdtree
