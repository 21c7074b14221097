#pragma once

#include "trace/world/ray_lists.h"
#include "trace/world/world.h"

#include <bit>

// The tree over instances, for one ray or shape.
namespace peregrine::trace {

// A ray as the nodes over instances see it; `entered` receives what it enters of their root.
class RayGate {
public:
    RayGate(const World& world, const math::Ray& ray, const Position& position,
            EnteredNode& entered)
        : world_(world) {
        world.ray_lists->enter_root(world.nodes[0], ray, ray_, entered);
        if (world.rests) [[unlikely]] {
            for (int k = 0; k < 3; ++k) ray_.rest[k] = position.rest(ray.origin[k], k);
            enter(0, ray.t_max, entered);
        }
    }

    void enter(uint32_t node, float t_max, EnteredNode& entered) const {
        if (world_.rests) [[unlikely]]
            world_.ray_lists->enter_node_far(world_.nodes[node], world_.rests[node], ray_, t_max,
                                             entered);
        else
            world_.ray_lists->enter_node(world_.nodes[node], ray_, t_max, entered);
    }

private:
    const World& world_;
    GateRay ray_;
};

// Calls visit(instance) for those below the root's children `entered` that what the gate stands
// for may meet before `t_max`, which may shrink meanwhile, roughly from front to back, until visit
// returns true.
template <class Gate, class Visit>
bool visit_instances(const World& world, const Gate& gate, EnteredNode& entered, const float& t_max,
                     Visit&& visit) {
    using accel::instances::Link;
    using accel::instances::Node;
    struct Entry {
        float t;
        Link link;
    };
    Entry stack[accel::instances::kStackSize];
    Entry* top = stack;
    const auto push = [&](const Node& node) { // the nearest last
        Entry* const bottom = top;
        for (uint32_t left = entered.children; left; left &= left - 1) {
            const auto i = uint32_t(std::countr_zero(left));
            Entry* place = top++;
            for (; place != bottom && place[-1].t < entered.t_near[i]; --place) *place = place[-1];
            *place = {entered.t_near[i], node.child[i]};
        }
    };
    push(world.nodes[0]);
    while (top != stack) {
        const auto [t, link] = *--top;
        if (t > t_max) continue;
        if (link.is_leaf()) {
            if (visit(world.instances[link.instance()])) return true;
        } else {
            gate.enter(link.node(), t_max, entered);
            push(world.nodes[link.node()]);
        }
    }
    return false;
}

} // namespace peregrine::trace
