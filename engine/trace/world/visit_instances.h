#pragma once

#include "trace/slabs.h"
#include "trace/world/world.h"

#include <algorithm>
#include <limits>

// The tree over instances, for one ray or shape.
namespace peregrine::trace {

inline constexpr double kNowhere = std::numeric_limits<double>::infinity();

// A ray as the nodes over instances see it.
class RayGate {
public:
    explicit RayGate(const math::Ray& ray)
        : distance_(largest_component(ray.origin)), t_min_(ray.t_min) {
        const float largest = largest_component(ray.direction), smallest = 0x1p-26f * largest;
        is_usual_ = largest >= 0x1p-32f && largest <= 0x1p32f && distance_ <= 0x1p60f;
        for (int k = 0; k < 3; ++k) {
            const float d = ray.direction[k];
            origin_[k] = ray.origin[k];
            inverse_[k] = 1 / (std::fabs(d) < smallest ? std::copysign(smallest, d) : d);
        }
    }

    // Where the ray may enter; beyond `t_max`: nowhere.
    double enter(const accel::instances::Extent& extent, double t_max) const {
        const float margin = extent.margin + extent.slope * distance_;
        float t_near = t_min_, t_far = float(t_max);
        for (int k = 0; k < 3; ++k) {
            const float a = ((extent.box.lower[k] - margin) - origin_[k]) * inverse_[k];
            const float b = ((extent.box.upper[k] + margin) - origin_[k]) * inverse_[k];
            t_near = std::max(t_near, std::min(a, b));
            t_far = std::min(t_far, std::max(a, b));
        }
        // Of an unusual ray float may say anything.
        return t_near <= t_far ? double(t_near) : is_usual_ ? kNowhere : double(t_min_);
    }

private:
    float origin_[3];
    float inverse_[3];
    float distance_;
    float t_min_;
    bool is_usual_;
};

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
