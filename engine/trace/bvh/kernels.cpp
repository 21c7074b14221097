#include "trace/bvh/kernels.h"

#include "trace/bvh/plain.h"
#include "trace/bvh/simd_kernels.h"
#include "trace/each.h"

namespace peregrine::trace::bvh {
namespace {

template <bool Filtered>
Hit closest(const Target& target, const math::Ray& ray, const Filter& filter) {
    return is_regular(target, ray) ? closest_plain<Filtered, float>(target, ray, filter)
                                   : closest_plain<Filtered, double>(target, ray, filter);
}

Hit closest(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return miss(0);
    return filter.trivial() ? closest<false>(target, ray, filter)
                            : closest<true>(target, ray, filter);
}

template <bool Filtered>
bool occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
    return is_regular(target, ray) ? occluded_plain<Filtered, float>(target, ray, filter)
                                   : occluded_plain<Filtered, double>(target, ray, filter);
}

bool occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return false;
    return filter.trivial() ? occluded<false>(target, ray, filter)
                            : occluded<true>(target, ray, filter);
}

} // namespace

Kernels make_kernels(base::Isa isa) {
    if (const Kernels* kernels = simd_kernels(isa)) return *kernels;
    return {closest, occluded, closest_each<closest>, occluded_each<occluded>, isa};
}

} // namespace peregrine::trace::bvh
