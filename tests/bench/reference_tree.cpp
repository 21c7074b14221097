#include "reference_tree.h"

#include <numeric>

namespace peregrine::bench {
namespace {

constexpr uint32_t kLeaf = 4; // triangles at most

} // namespace

ReferenceTree::ReferenceTree(std::span<const geometry::Triangle> triangles) {
    for (const geometry::Triangle& triangle : triangles) {
        const Corners<double> corners{
            {math::Vec3d(triangle.v0), math::Vec3d(triangle.v1), math::Vec3d(triangle.v2)}};
        BoxD box;
        for (const math::Vec3d& v : corners.v) box.extend(v);
        corners_.push_back(corners);
        boxes_.push_back(box);
    }
    order_.resize(triangles.size());
    std::iota(order_.begin(), order_.end(), 0u);
    build(0, uint32_t(triangles.size()));
}

uint32_t ReferenceTree::build(uint32_t first, uint32_t count) {
    const uint32_t index = uint32_t(nodes_.size());
    nodes_.push_back({{}, {}, first, count});
    BoxD box, centers;
    for (uint32_t i = first; i < first + count; ++i) {
        const BoxD& of_triangle = boxes_[order_[i]];
        box.extend(of_triangle);
        centers.extend(of_triangle.lower + of_triangle.upper);
    }
    nodes_[index].box = box;
    if (count <= kLeaf) return index;
    const math::Vec3d size = centers.upper - centers.lower;
    const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    const uint32_t half = count / 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [&](uint32_t a, uint32_t b) {
        return boxes_[a].lower[axis] + boxes_[a].upper[axis]
               < boxes_[b].lower[axis] + boxes_[b].upper[axis];
    });
    const uint32_t left = build(first, half);
    const uint32_t right = build(first + half, count - half);
    nodes_[index].children[0] = left;
    nodes_[index].children[1] = right;
    nodes_[index].count = 0;
    return index;
}

} // namespace peregrine::bench
