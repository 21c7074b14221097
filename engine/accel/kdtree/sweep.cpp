#include "accel/kdtree/sweep.h"

#include <algorithm>

namespace peregrine::accel::kdtree {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Events below `inside` or from `outside` on are on the cell's border: no planes to split at.
struct Interior {
    Event inside;
    Event outside;

    Interior(const math::Box& cell, uint32_t axis)
        : inside((Event(ordered(cell.lower[int(axis)])) + 1) << 32),
          outside(Event(ordered(cell.upper[int(axis)])) << 32) {}

    bool contains(Event event) const { return event >= inside && event < outside; }
};

// Algorithm 4 of Wald and Havran 2006, without its grouping by position: between the events of one
// position the counts are merely too large, so that the group's true costs win. Calls visit(plane,
// boundary, left, right) until it returns false.
template <class Visit>
void sweep(std::span<const Event> events, uint32_t triangles, const Interior& interior,
           Visit&& visit) {
    const uint32_t count = uint32_t(events.size());
    uint32_t left = 0;
    uint32_t right = triangles;
    uint32_t i = 0;
    for (; i < count && events[i] < interior.inside; ++i) {
        ++left;
        right -= type(events[i]) == kPlanar;
    }
    for (; i < count && events[i] < interior.outside; ++i) {
        const float plane = position(events[i]);
        const EventType kind = type(events[i]);
        if (kind == kPlanar) [[unlikely]] {
            if (!visit(plane, i, left, right)) return;
            ++left;
            --right;
            if (!visit(plane, i + 1, left, right)) return;
            continue;
        }
        const uint32_t ends = kind == kEnd;
        right -= ends;
        if (!visit(plane, i + ends, left, right)) return;
        left += 1 - ends;
    }
}

// The planes that cut off empty space: only the first and the last can.
double cost_before_all(std::span<const Event> events, uint32_t triangles, const PlaneCost& cost,
                       const Interior& interior) {
    if (!cost.has_bonus() || !interior.contains(events.front())) return kInfinity;
    return cost.empty_factor()
           * cost.node(cost.children(double(position(events.front())), 0.0, double(triangles)));
}

double cost_behind_all(std::span<const Event> events, uint32_t triangles, const PlaneCost& cost,
                       const Interior& interior) {
    if (!cost.has_bonus() || !interior.contains(events.back())) return kInfinity;
    return cost.empty_factor()
           * cost.node(cost.children(double(position(events.back())), double(triangles), 0.0));
}

} // namespace

double cheapest_plane(std::span<const Event> events, uint32_t triangles, const math::Box& cell,
                      uint32_t axis, const CostModel& model) {
    if (events.empty()) return kInfinity;
    const PlaneCost cost(model, cell, axis);
    const Interior interior(cell, axis);
    double least = kInfinity; // all without a branch: which event comes next is hard to predict
    sweep(events, triangles, interior, [&](float plane, uint32_t, uint32_t left, uint32_t right) {
        const double children = cost.children(double(plane), double(left), double(right));
        least = children < least ? children : least;
        return true;
    });
    return std::min({cost.node(least), cost_before_all(events, triangles, cost, interior),
                     cost_behind_all(events, triangles, cost, interior)});
}

Split locate_plane(std::span<const Event> events, uint32_t triangles, const math::Box& cell,
                   uint32_t axis, const CostModel& model, double wanted) {
    const PlaneCost cost(model, cell, axis);
    const Interior interior(cell, axis);
    if (cost_before_all(events, triangles, cost, interior) == wanted)
        return {wanted, position(events.front()), axis, 0, 0, triangles};
    if (cost_behind_all(events, triangles, cost, interior) == wanted)
        return {wanted, position(events.back()), axis, uint32_t(events.size()), triangles, 0};
    Split split;
    sweep(events, triangles, interior,
          [&](float plane, uint32_t boundary, uint32_t left, uint32_t right) {
              if (cost.node(cost.children(double(plane), double(left), double(right))) != wanted)
                  return true;
              split = {wanted, plane, axis, boundary, left, right};
              return false;
          });
    return split;
}

} // namespace peregrine::accel::kdtree
