#include "trace/visibility/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace peregrine::trace::visibility {
namespace {

constexpr double kThinnest = 0x1p-20; // sine of an angle of a triangle that has a normal

class Builder {
public:
    explicit Builder(TriangleTree& tree, base::Memory* memory)
        : tree_(tree), boxes_(memory), order_(tree.triangles.size(), memory) {
        std::iota(order_.begin(), order_.end(), 0u);
        boxes_.reserve(tree.triangles.size());
        for (const Corners& c : tree.triangles)
            boxes_.push_back({glm::min(glm::min(c.v[0], c.v[1]), c.v[2]),
                              glm::max(glm::max(c.v[0], c.v[1]), c.v[2])});
    }

    // Halved each time: as deep as the logarithm of the count.
    void build(uint32_t node, uint32_t first, uint32_t last) {
        math::Box box, centers;
        for (uint32_t i = first; i < last; ++i) {
            box.extend(boxes_[order_[i]]);
            centers.extend(center(order_[i]));
        }
        if (last - first <= TriangleTree::kLeafSize) {
            tree_.nodes[node] = {box, first, last - first};
            for (uint32_t i = first; i < last; ++i)
                tree_.ordered.emplace_back(tree_.triangles[order_[i]], order_[i]);
            return;
        }
        const math::Vec3 size = centers.upper - centers.lower;
        const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
        const uint32_t middle = first + (last - first) / 2;
        std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                         [&](uint32_t a, uint32_t b) {
                             const float x = center(a)[axis], y = center(b)[axis];
                             return x < y || (x == y && a < b);
                         });
        const auto children = uint32_t(tree_.nodes.size());
        tree_.nodes[node] = {box, children, 0};
        tree_.nodes.resize(children + 2);
        build(children, first, middle);
        build(children + 1, middle, last);
    }

private:
    math::Vec3 center(uint32_t triangle) const {
        return boxes_[triangle].lower * 0.5f + boxes_[triangle].upper * 0.5f;
    }

    TriangleTree& tree_;
    base::Vector<math::Box> boxes_;
    base::Vector<uint32_t> order_;
};

} // namespace

TreeTriangle::TreeTriangle(const Corners& corners, uint32_t index_)
    : normal(0), index(index_), masked(corners.masked) {
    for (int k = 0; k < 3; ++k) v[k] = math::Vec3d(corners.v[k]);
    const math::Vec3d a = v[1] - v[0], b = v[2] - v[0], c = v[2] - v[1];
    const math::Vec3d n = glm::cross(a, b);
    const double area = std::sqrt(glm::dot(n, n));
    const double longest = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)});
    if (area > kThinnest * longest) normal = n / area;
}

TriangleTree::TriangleTree(std::span<const Corners> triangles_, base::Memory* memory)
    : triangles(triangles_), nodes(memory), ordered(memory) {
    if (triangles.empty()) return;
    ordered.reserve(triangles.size());
    nodes.reserve(triangles.size());
    nodes.resize(1);
    Builder(*this, memory).build(0, 0, uint32_t(triangles.size()));
}

} // namespace peregrine::trace::visibility
