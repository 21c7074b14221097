#include "accel/bvh/treelet.h"

#include "accel/bvh/object_split.h"

#include <algorithm>
#include <bit>

namespace peregrine::accel::bvh {
namespace {

class Treelet {
public:
    Treelet(std::span<Reference> references, const TreeletLeaves& leaves,
            base::Vector<BinaryNode>& nodes)
        : references_(references), leaves_(leaves), nodes_(nodes) {
        const uint32_t count = uint32_t(references.size());
        Bounds all;
        for (uint32_t i = 0; i < count; ++i) {
            boxes_[i] = references[i].bounds();
            weights_[i] = references[i].weight();
            all.extend(boxes_[i]);
        }
        scale_ = scale_of(all);
        for (int axis = 0; axis < 3; ++axis) sort(axis, count, 2 * all.lower[axis]);
    }

    void build() {
        const uint32_t count = uint32_t(references_.size());
        build_node(0, count);
        Reference sorted[kMaxTreelet];
        for (uint32_t i = 0; i < count; ++i) sorted[i] = references_[sorted_[0][i]];
        std::copy_n(sorted, count, references_.data());
    }

private:
    struct Cut {
        float cost = std::numeric_limits<float>::infinity();
        int axis = 0;
        uint32_t lefts = 0;
    };

    // By counting how many come before: all have different keys, as these end in the index.
    void sort(int axis, uint32_t count, float origin) {
        int32_t keys[kMaxTreelet];
        int32_t places[kMaxTreelet] = {};
        std::fill_n(keys, kMaxTreelet, std::numeric_limits<int32_t>::max());
        for (uint32_t i = 0; i < count; ++i) {
            const float center = boxes_[i].lower[axis] + boxes_[i].upper[axis] - origin;
            keys[i] = int32_t((std::bit_cast<uint32_t>(center) & ~(kMaxTreelet - 1)) | i);
        }
        for (uint32_t j = 0; j < count; ++j)
            for (uint32_t i = 0; i < kMaxTreelet; ++i) places[i] += keys[j] < keys[i];
        for (uint32_t i = 0; i < count; ++i) sorted_[axis][places[i]] = uint8_t(i);
    }

    void build_node(uint32_t begin, uint32_t end) {
        const uint32_t number = uint32_t(nodes_.size());
        BinaryNode& node = nodes_.emplace_back();
        Bounds bounds;
        for (uint32_t i = begin; i < end; ++i) bounds.extend(boxes_[sorted_[0][i]]);
        node.set_bounds(bounds);
        if (end - begin <= leaves_.most) {
            node.first = leaves_.first + begin;
            node.second = BinaryNode::kLeaf | (end - begin);
            return;
        }
        Cut best;
        for (int axis = 0; axis < 3; ++axis) sweep(begin, end, axis, best);
        separate(begin, end, best);
        node.first = number + 1;
        build_node(begin, begin + best.lefts);
        nodes_[number].second = uint32_t(nodes_.size());
        build_node(begin + best.lefts, end);
    }

    float area(const Bounds& bounds) const {
        return half_area((bounds.upper - bounds.lower) * scale_);
    }

    void sweep(uint32_t begin, uint32_t end, int axis, Cut& best) const {
        const uint8_t* sorted = sorted_[axis] + begin;
        const uint32_t count = end - begin;
        float right_cost[kMaxTreelet];
        Bounds box;
        uint32_t weight = 0;
        for (uint32_t i = count - 1; i > 0; --i) {
            box.extend(boxes_[sorted[i]]);
            weight += weights_[sorted[i]];
            right_cost[i] = area(box) * blocks_of(weight);
        }
        box = {};
        weight = 0;
        for (uint32_t i = 1; i < count; ++i) {
            box.extend(boxes_[sorted[i - 1]]);
            weight += weights_[sorted[i - 1]];
            const float cost = area(box) * blocks_of(weight) + right_cost[i];
            if (cost < best.cost) best = {cost, axis, i};
        }
    }

    void separate(uint32_t begin, uint32_t end, Cut& best) {
        if (best.lefts == 0) best.lefts = (end - begin) / 2; // if an area is not a number
        bool to_left[kMaxTreelet];
        for (uint32_t i = begin; i < end; ++i)
            to_left[sorted_[best.axis][i]] = i < begin + best.lefts;
        for (int axis = 0; axis < 3; ++axis) {
            if (axis == best.axis) continue;
            uint8_t* sorted = sorted_[axis];
            uint8_t rights[kMaxTreelet];
            uint32_t left = begin;
            uint32_t right = 0;
            for (uint32_t i = begin; i < end; ++i) {
                const uint8_t index = sorted[i];
                sorted[left] = index;
                rights[right] = index;
                left += to_left[index];
                right += !to_left[index];
            }
            std::copy_n(rights, right, sorted + left);
        }
    }

    std::span<Reference> references_;
    TreeletLeaves leaves_;
    base::Vector<BinaryNode>& nodes_;
    Bounds boxes_[kMaxTreelet];
    uint32_t weights_[kMaxTreelet];
    uint8_t sorted_[3][kMaxTreelet];
    float scale_;
};

} // namespace

void build_treelet(std::span<Reference> references, const TreeletLeaves& leaves,
                   base::Vector<BinaryNode>& nodes) {
    Treelet(references, leaves, nodes).build();
}

} // namespace peregrine::accel::bvh
