#include "trace/kdtree/kernels.h"

#include "trace/each.h"
#include "trace/kdtree/single.h"
#include "trace/kdtree/stream_kernels.h"

namespace peregrine::trace::kdtree {
namespace {

template <bool Filtered>
Hit closest(const Target& target, const math::Ray& ray, const Filter& filter) {
    const float distance = reach<float>(target.bounds, ray.origin);
    return fits_float(largest_component(ray.direction), distance)
               ? closest_single<Filtered>(target, ray, filter, distance)
               : closest_single<Filtered>(target, ray, filter,
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
               ? occluded_single<Filtered>(target, ray, filter, distance)
               : occluded_single<Filtered>(target, ray, filter,
                                           reach<double>(target.bounds, ray.origin));
}

bool occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return false;
    return filter.trivial() ? occluded<false>(target, ray, filter)
                            : occluded<true>(target, ray, filter);
}

} // namespace

Kernels make_kernels(base::Isa isa) {
    const StreamKernels* streams = stream_kernels(isa);
    return {closest, occluded, streams ? streams->closest : closest_each<closest>,
            streams ? streams->occluded : occluded_each<occluded>, isa};
}

} // namespace peregrine::trace::kdtree
