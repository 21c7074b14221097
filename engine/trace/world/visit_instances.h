#pragma once

#include "trace/slabs.h"
#include "trace/world/world.h"

#include <algorithm>
#include <limits>

// The tree over instances, for one ray or shape.
namespace peregrine::trace {

// A ray as the nodes over instances see it; in double, where no ray is extreme.
class RayGate {
public:
    explicit RayGate(const math::Ray& ray) : t_min_(double(ray.t_min)) {
        const double smallest = 0x1p-26 * double(largest_component(ray.direction));
        for (int k = 0; k < 3; ++k) {
            const double d = double(ray.direction[k]);
            origin_[k] = double(ray.origin[k]);
            inverse_[k] = 1 / (std::abs(d) < smallest ? std::copysign(smallest, d) : d);
        }
        distance_ = double(largest_component(ray.origin));
    }

    // Where the ray may enter; beyond `t_max`: nowhere.
    double enter(const accel::instances::Extent& extent, double t_max) const {
        const double margin = double(extent.margin) + double(extent.slope) * distance_;
        double t_near = t_min_, t_far = t_max;
        for (int k = 0; k < 3; ++k) {
            const double a = (double(extent.box.lower[k]) - margin - origin_[k]) * inverse_[k];
            const double b = (double(extent.box.upper[k]) + margin - origin_[k]) * inverse_[k];
            t_near = std::max(t_near, std::min(a, b));
            t_far = std::min(t_far, std::max(a, b));
        }
        return t_near <= t_far ? t_near : std::numeric_limits<double>::infinity();
    }

private:
    double origin_[3];
    double inverse_[3];
    double distance_;
    double t_min_;
};

inline constexpr double kNowhere = std::numeric_limits<double>::infinity();

// Calls visit(instance) for those that what the gate stands for, which enters at `entry`, may meet
// before `t_max`, which may shrink meanwhile, roughly from front to back, until visit returns true.
template <class Gate, class Visit>
bool visit_instances(const World& world, const Gate& gate, double entry, const float& t_max,
                     Visit&& visit) {
    struct Entry {
        uint32_t node;
        double t;
    };
    Entry stack[accel::instances::kMaxDepth];
    uint32_t height = 0;
    Entry at = {0, entry};
    for (;;) {
        while (at.t <= double(t_max) && at.t < kNowhere) {
            const accel::instances::Node& node = world.nodes[at.node];
            if (node.right == 0) {
                if (visit(world.instances[node.instance])) return true;
                break;
            }
            const uint32_t left = at.node + 1;
            Entry near = {left, gate.enter(world.nodes[left].extent, double(t_max))};
            Entry far = {node.right, gate.enter(world.nodes[node.right].extent, double(t_max))};
            if (far.t < near.t) std::swap(near, far);
            if (far.t < kNowhere) stack[height++] = far;
            at = near;
        }
        if (height == 0) return false;
        at = stack[--height];
    }
}

} // namespace peregrine::trace
