// Rays alone, compiled once for each instruction set.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/single/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/stream/calls-inl.h"

#if HWY_TARGET != HWY_SCALAR // there the plain kernels do the work
#include "trace/bvh/single/single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

template <class View>
HWY_INLINE HWY_ATTR Hit closest_of(const Target& target, const math::Ray& ray,
                                   const Filter& filter) {
    if (target.bounds.empty()) return miss(0);
    return filter.trivial() ? closest<View, false>(target, ray, filter)
                            : closest<View, true>(target, ray, filter);
}

template <class View>
HWY_INLINE HWY_ATTR bool occluded_of(const Target& target, const math::Ray& ray,
                                     const Filter& filter) {
    if (target.bounds.empty()) return false;
    return filter.trivial() ? occluded<View, false>(target, ray, filter)
                            : occluded<View, true>(target, ray, filter);
}

HWY_ATTR Hit closest_full(const Target& target, const math::Ray& ray, const Filter& filter) {
    return closest_of<FullView>(target, ray, filter);
}
HWY_ATTR Hit closest_compact(const Target& target, const math::Ray& ray, const Filter& filter) {
    return closest_of<CompactView>(target, ray, filter);
}
HWY_ATTR bool occluded_full(const Target& target, const math::Ray& ray, const Filter& filter) {
    return occluded_of<FullView>(target, ray, filter);
}
HWY_ATTR bool occluded_compact(const Target& target, const math::Ray& ray, const Filter& filter) {
    return occluded_of<CompactView>(target, ray, filter);
}
HWY_ATTR void visit_full(const Target& target, const math::Ray& ray, Visitor& visitor) {
    visit<FullView>(target, ray, visitor);
}
HWY_ATTR void visit_compact(const Target& target, const math::Ray& ray, Visitor& visitor) {
    visit<CompactView>(target, ray, visitor);
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
