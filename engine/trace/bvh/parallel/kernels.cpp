// Beams of parallel rays, compiled once for each instruction set.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/parallel/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/stream/calls-inl.h"

#if !PEREGRINE_PLAIN_TARGET // there the plain kernels do the work
#include "trace/bvh/beam/occluded-inl.h"
#include "trace/bvh/parallel/children-inl.h"
#include "trace/bvh/parallel/facet-inl.h"
#include "trace/bvh/parallel/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

HWY_ATTR bool occluded_parallel(const Target& target, ParallelBeam& beam, const RayStream& rays,
                                const Filter& filter, uint8_t* occluded) {
    return filter.trivial()
               ? OccludedBeam<ParallelBeam, false>(target, beam, rays, filter).trace(occluded)
               : OccludedBeam<ParallelBeam, true>(target, beam, rays, filter).trace(occluded);
}

constinit const ParallelCalls kParallels = {occluded_parallel};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
