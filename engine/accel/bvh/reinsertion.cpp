#include "accel/bvh/reinsertion.h"

#include "accel/bvh/object_split.h"

#include <algorithm>
#include <utility>

namespace peregrine::accel::bvh {
namespace {

constexpr uint32_t kNone = ~0u;
constexpr uint32_t kMany = 255;
// Subtrees of so few references stay whole: they become blocks.
constexpr uint32_t kWhole = kBlockWidth;

constexpr uint32_t kSearchesPerTask = 256;

struct Move {
    float gain;
    uint32_t node;
    uint32_t place; // whose sibling it becomes
};

class Optimiser {
public:
    Optimiser(const Task& task, base::Vector<BinaryNode>& nodes)
        : task_(task), nodes_(nodes), parents_(nodes.size(), task.memory),
          references_(nodes.size(), task.memory), touched_(nodes.size(), task.memory),
          moves_(task.memory) {
        parents_[0] = kNone;
        for (uint32_t i = uint32_t(nodes.size()); i-- > 0;) {
            if (nodes[i].is_leaf()) {
                references_[i] = uint8_t(std::min(nodes[i].count(), kMany));
                continue;
            }
            parents_[nodes[i].first] = parents_[nodes[i].second] = i;
            references_[i] = uint8_t(std::min(
                uint32_t(references_[nodes[i].first]) + references_[nodes[i].second], kMany));
        }
    }

    void run(base::Scheduler& scheduler) {
        choose();
        const uint32_t count = uint32_t(moves_.size());
        scheduler.for_each((count + kSearchesPerTask - 1) / kSearchesPerTask, [&](uint32_t chunk) {
            if (task_.control.cancelled()) return;
            const uint32_t end = std::min(count, (chunk + 1) * kSearchesPerTask);
            for (uint32_t i = chunk * kSearchesPerTask; i < end; ++i) search(moves_[i]);
        });
        task_.control.throw_if_cancelled();
        std::erase_if(moves_, [](const Move& move) { return move.gain <= 0; });
        std::sort(moves_.begin(), moves_.end(), gains_more);
        for (const Move& move : moves_) apply(move);
    }

private:
    // The nodes with the largest areas have most to gain.
    void choose() {
        for (uint32_t i = 1; i < nodes_.size(); ++i)
            if (parents_[i] != 0 && !is_whole(parents_[i]))
                moves_.push_back({area(bounds(i)), i, kNone});
        const size_t chosen = size_t(double(moves_.size()) * task_.effort.reinserted);
        if (chosen >= moves_.size()) return;
        std::nth_element(moves_.begin(), moves_.begin() + ptrdiff_t(chosen), moves_.end(),
                         gains_more);
        moves_.resize(chosen);
    }

    static bool gains_more(const Move& a, const Move& b) {
        return a.gain != b.gain ? a.gain > b.gain : a.node < b.node;
    }

    // The place with the largest gain. Up from the node, the tree is as without it, and the
    // siblings' subtrees are searched, but for those that cannot gain more than was found.
    void search(Move& move) const {
        struct Entry {
            float gain; // with the area of all nodes down to here, enlarged, taken off
            uint32_t node;
        };
        Entry stack[128];
        const Bounds box = bounds(move.node);
        const float own_area = area(box);
        const uint32_t parent = parents_[move.node];
        uint32_t pivot = move.node;
        Bounds without;
        float gain = area(bounds(parent));
        move.gain = 0;
        while (parents_[pivot] != kNone) {
            uint32_t count = 0;
            stack[count++] = {gain, sibling(pivot)};
            while (count > 0) {
                const Entry entry = stack[--count];
                if (entry.gain - own_area <= move.gain) continue;
                const BinaryNode& node = nodes_[entry.node];
                const Bounds place = node.bounds();
                Bounds merged = place;
                merged.extend(box);
                const float found = entry.gain - area(merged);
                if (found > move.gain) move = {found, move.node, entry.node};
                if (is_whole(entry.node) || count + 2 > std::size(stack)) continue;
                const float below = found + area(place);
                if (below - own_area <= move.gain) continue;
                stack[count++] = {below, node.first};
                stack[count++] = {below, node.second};
            }
            without.extend(bounds(sibling(pivot)));
            pivot = parents_[pivot];
            if (pivot != parent) gain += area(bounds(pivot)) - area(without);
        }
        if (move.place != kNone && move.place == sibling(move.node)) move.gain = 0;
    }

    void apply(const Move& move) {
        const uint32_t parent = parents_[move.node];
        const uint32_t other = sibling(move.node);
        const uint32_t above = parents_[parent];
        const uint32_t above_place = parents_[move.place];
        if (above == kNone || above_place == kNone || move.place == parent) return;
        for (uint32_t node : {move.node, parent, other, above, move.place, above_place})
            if (touched_[node]) return;
        // An earlier move may have brought the place into the subtree.
        for (uint32_t node = move.place; node != kNone; node = parents_[node])
            if (node == move.node) return;
        for (uint32_t node : {move.node, parent, other, above, move.place, above_place})
            touched_[node] = 1;

        replace_child(above, parent, other);
        replace_child(above_place == parent ? above : above_place, move.place, parent);
        nodes_[parent].first = move.place;
        nodes_[parent].second = move.node;
        parents_[move.place] = parent;
        refit(above);
        refit(parent);
    }

    void replace_child(uint32_t node, uint32_t old, uint32_t child) {
        BinaryNode& binary = nodes_[node];
        (binary.first == old ? binary.first : binary.second) = child;
        parents_[child] = node;
    }

    void refit(uint32_t node) {
        for (; node != kNone; node = parents_[node]) {
            Bounds box = bounds(nodes_[node].first);
            box.extend(bounds(nodes_[node].second));
            nodes_[node].set_bounds(box);
        }
    }

    bool is_whole(uint32_t node) const { return references_[node] <= kWhole; }
    uint32_t sibling(uint32_t node) const {
        const BinaryNode& parent = nodes_[parents_[node]];
        return parent.first == node ? parent.second : parent.first;
    }
    Bounds bounds(uint32_t node) const { return nodes_[node].bounds(); }
    float area(const Bounds& bounds) const {
        return half_area((bounds.upper - bounds.lower) * task_.root_scale);
    }

    const Task& task_;
    base::Vector<BinaryNode>& nodes_;
    base::Vector<uint32_t> parents_;
    base::Vector<uint8_t> references_;
    base::Vector<uint8_t> touched_;
    base::Vector<Move> moves_;
};

// Parents before children again. False if the tree has grown too deep.
bool lay_out(const base::Vector<BinaryNode>& nodes, base::Vector<BinaryNode>& sorted) {
    struct Entry {
        uint32_t node;
        uint32_t parent;
        uint32_t depth;
    };
    Entry stack[kMaxBinaryDepth + 2];
    uint32_t count = 0;
    stack[count++] = {0, kNone, 0};
    sorted.clear();
    sorted.reserve(nodes.size());
    while (count > 0) {
        const Entry entry = stack[--count];
        if (entry.depth > kMaxBinaryDepth) return false;
        const uint32_t number = uint32_t(sorted.size());
        const BinaryNode& node = sorted.emplace_back(nodes[entry.node]);
        if (entry.parent != kNone && number != entry.parent + 1)
            sorted[entry.parent].second = number;
        if (node.is_leaf()) continue;
        stack[count++] = {node.second, number, entry.depth + 1};
        stack[count++] = {node.first, number, entry.depth + 1};
        sorted[number].first = number + 1;
    }
    return true;
}

} // namespace

void reinsert(const Task& task, base::Scheduler& scheduler, BinaryTree& tree) {
    if (tree.nodes.size() < 7) return;
    base::Vector<BinaryNode> moved(task.memory);
    base::Vector<BinaryNode> sorted(task.memory);
    for (uint32_t round = 0; round < task.effort.reinsertions; ++round) {
        moved.assign(tree.nodes.begin(), tree.nodes.end());
        Optimiser(task, moved).run(scheduler);
        if (!lay_out(moved, sorted)) return;
        tree.nodes.swap(sorted);
        tree.parts.clear();
    }
}

} // namespace peregrine::accel::bvh
