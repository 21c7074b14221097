#pragma once

#include "distance.h"
#include "geometry/triangle.h"

#include <algorithm>
#include <span>
#include <vector>

namespace peregrine::bench {

struct BoxD {
    math::Vec3d lower{std::numeric_limits<double>::infinity()};
    math::Vec3d upper{-std::numeric_limits<double>::infinity()};

    void extend(const math::Vec3d& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    void extend(const BoxD& box) {
        lower = glm::min(lower, box.lower);
        upper = glm::max(upper, box.upper);
    }
    bool meets(const BoxD& box) const {
        return glm::all(glm::lessThanEqual(lower, box.upper))
               && glm::all(glm::lessThanEqual(box.lower, upper));
    }
};

// A plain tree of boxes in double, halved at medians: nothing of the engine's.
class ReferenceTree {
public:
    explicit ReferenceTree(std::span<const geometry::Triangle> triangles);

    const Corners<double>& corners(uint32_t triangle) const { return corners_[triangle]; }

    // visit(triangle) for all that come within `pad` (per axis) of origin + t direction for
    // 0 <= t <= t_max, nearer boxes first; visit may lower t_max.
    template <class Visit>
    void visit_along(const math::Vec3d& origin, const math::Vec3d& direction,
                     const math::Vec3d& pad, const double& t_max, const Visit& visit) const {
        const Way way{origin, 1.0 / direction, pad};
        if (way.enter(nodes_[0].box) <= t_max) descend_along(0, way, t_max, visit);
    }

    // visit(triangle) for all whose boxes meet this one.
    template <class Visit>
    void visit_within(const BoxD& box, const Visit& visit, uint32_t index = 0) const {
        const Node& node = nodes_[index];
        if (!node.box.meets(box)) return;
        for (uint32_t i = node.first; i < node.first + node.count; ++i)
            if (boxes_[order_[i]].meets(box)) visit(order_[i]);
        if (node.count) return;
        visit_within(box, visit, node.children[0]);
        visit_within(box, visit, node.children[1]);
    }

private:
    struct Node {
        BoxD box;
        uint32_t children[2];  // of inner nodes
        uint32_t first, count; // of leaves; inner nodes have 0 triangles
    };

    struct Way {
        math::Vec3d origin, inverse, pad;

        // When the way comes to the padded box; infinity: never. A hair is added on both sides for
        // the rounding of this function itself.
        double enter(const BoxD& box) const {
            double first = 0, last = std::numeric_limits<double>::infinity();
            for (int k = 0; k < 3; ++k) {
                const double lower = box.lower[k] - pad[k] - origin[k];
                const double upper = box.upper[k] + pad[k] - origin[k];
                if (lower <= 0 && upper >= 0 && std::isinf(inverse[k])) continue;
                const double a = lower * inverse[k], b = upper * inverse[k];
                first = std::max(first, std::min(a, b));
                last = std::min(last, std::max(a, b));
            }
            constexpr double kHair = 1e-12;
            return first * (1 - kHair) <= last * (1 + kHair)
                       ? first * (1 - kHair)
                       : std::numeric_limits<double>::infinity();
        }
    };

    template <class Visit>
    void descend_along(uint32_t index, const Way& way, const double& t_max,
                       const Visit& visit) const {
        const Node& node = nodes_[index];
        for (uint32_t i = node.first; i < node.first + node.count; ++i) visit(order_[i]);
        if (node.count) return;
        double enter[2];
        for (int k = 0; k < 2; ++k) enter[k] = way.enter(nodes_[node.children[k]].box);
        const int near = enter[1] < enter[0];
        for (const int k : {near, 1 - near})
            if (std::isfinite(enter[k]) && enter[k] <= t_max)
                descend_along(node.children[k], way, t_max, visit);
    }

    uint32_t build(uint32_t first, uint32_t count);

    std::vector<Corners<double>> corners_;
    std::vector<BoxD> boxes_;
    std::vector<uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace peregrine::bench
