// Rays alone, compiled once for each instruction set.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/single/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/stream/calls-inl.h"

#if !PEREGRINE_PLAIN_TARGET // there the plain kernels do the work
#include "trace/bvh/single/single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

template <class View>
HWY_ATTR Hit closest_of(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return miss(0);
    return filter.trivial() ? closest<View, false>(target, ray, filter)
                            : closest<View, true>(target, ray, filter);
}

template <class View>
HWY_ATTR bool occluded_of(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return false;
    return filter.trivial() ? occluded<View, false>(target, ray, filter)
                            : occluded<View, true>(target, ray, filter);
}

template <class View>
constexpr SingleKernels make_singles() {
    return {closest_of<View>, occluded_of<View>, visit<View>};
}
constinit const SingleKernels kSingles = make_singles<FullView>();
constinit const SingleKernels kCompactSingles = make_singles<CompactView>();

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
#include "simd/select.h"

namespace peregrine::trace::bvh {

const SingleKernels* single_kernels(base::Isa isa, bool compact) {
    return compact ? PEREGRINE_TABLE_FOR(isa, kCompactSingles) : PEREGRINE_TABLE_FOR(isa, kSingles);
}

} // namespace peregrine::trace::bvh
#endif
