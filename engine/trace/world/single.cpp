#include "trace/world/single.h"

#include "trace/world/merge.h"
#include "trace/world/visit_instances.h"

#include <algorithm>

namespace peregrine::trace {
namespace {

void take_first(const World& world, Hit hit, uint32_t first, Hit& best) {
    best.steps += hit.steps;
    if (hit.triangle == geometry::kNoTriangle) return;
    hit.triangle += first;
    if (!goes_before(world, hit.t, hit.back_face, hit.triangle, best.t, best.back_face,
                     best.triangle))
        return;
    hit.steps = best.steps;
    best = hit;
}

} // namespace

Hit closest_of_parts(const World& world, const math::Ray& ray, const Position& position,
                     const Filter& filter) {
    // Most rays miss all that moves: they pay for this alone.
    EnteredNode entered;
    const RayGate gate(world, ray, position, entered);
    if (entered.children == 0) return world.fixed.kernels->closest(world.fixed.target, ray, filter);
    Hit best = world.fixed.kernels->closest(world.fixed.target, ray, filter);
    math::Ray left = ray; // what is left of it in front of the best hit
    left.t_max = std::min(ray.t_max, best.t);
    visit_instances(world, gate, entered, left.t_max, [&](const Instance& instance) {
        math::Ray local;
        if (!sees(filter, instance) || !within(instance, left, position, local)) return false;
        const Part& part = instance.part;
        take_first(world,
                   part.kernels->closest(part.target, local, filter_within(filter, instance)),
                   part.first, best);
        left.t_max = std::min(ray.t_max, best.t);
        return false;
    });
    return best;
}

bool occluded_by_parts(const World& world, const math::Ray& ray, const Position& position,
                       const Filter& filter) {
    if (world.fixed.kernels->occluded(world.fixed.target, ray, filter)) return true;
    EnteredNode entered;
    const RayGate gate(world, ray, position, entered);
    return visit_instances(world, gate, entered, ray.t_max, [&](const Instance& instance) {
        math::Ray local;
        return sees(filter, instance) && within(instance, ray, position, local)
               && instance.part.kernels->occluded(instance.part.target, local,
                                                  filter_within(filter, instance));
    });
}

} // namespace peregrine::trace
