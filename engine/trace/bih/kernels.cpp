#include "trace/bih/kernels.h"

#include "trace/bih/plain.h"
#include "trace/each.h"

namespace peregrine::trace::bih {
namespace {

template <bool Filtered>
Hit closest(const Target& target, const math::Ray& ray, const Filter& filter) {
    const float distance = reach<float>(target.bounds, ray.origin);
    return fits_float(largest_component(ray.direction), distance)
               ? closest_plain<Filtered>(target, ray, filter, distance)
               : closest_plain<Filtered>(target, ray, filter,
                                         reach<double>(target.bounds, ray.origin));
}

Hit closest(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return miss(0);
    return filter.trivial() ? closest<false>(target, ray, filter)
                            : closest<true>(target, ray, filter);
}

template <bool Filtered>
bool occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
    const float distance = reach<float>(target.bounds, ray.origin);
    return fits_float(largest_component(ray.direction), distance)
               ? occluded_plain<Filtered>(target, ray, filter, distance)
               : occluded_plain<Filtered>(target, ray, filter,
                                          reach<double>(target.bounds, ray.origin));
}

bool occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return false;
    return filter.trivial() ? occluded<false>(target, ray, filter)
                            : occluded<true>(target, ray, filter);
}

} // namespace

// One ray at a time on every machine.
Kernels make_kernels(base::Isa isa) {
    return {closest, occluded, closest_each<closest>, occluded_each<occluded>, isa};
}

} // namespace peregrine::trace::bih
