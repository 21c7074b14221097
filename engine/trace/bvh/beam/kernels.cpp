// Beams, compiled once for each instruction set.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/beam/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/stream/calls-inl.h"

#if !PEREGRINE_PLAIN_TARGET // there the plain kernels do the work
#include "trace/bvh/beam/kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

HWY_ATTR void closest_beam(const Target& target, Beam& beam, const RayStream& rays,
                           const Filter& filter, const HitStream& hits) {
    if (filter.trivial())
        ClosestBeam<false>(target, beam, rays, filter, hits).trace();
    else
        ClosestBeam<true>(target, beam, rays, filter, hits).trace();
}

HWY_ATTR bool occluded_beam(const Target& target, Beam& beam, const RayStream& rays,
                            const Filter& filter, uint8_t* occluded) {
    return filter.trivial() ? OccludedBeam<Beam, false>(target, beam, rays, filter).trace(occluded)
                            : OccludedBeam<Beam, true>(target, beam, rays, filter).trace(occluded);
}

constinit const BeamCalls kBeams = {closest_beam, occluded_beam};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
