// Pencils, compiled once for each instruction set.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/pencil/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/stream/calls-inl.h"

#if !PEREGRINE_PLAIN_TARGET // there the plain kernels do the work
#include "trace/bvh/pencil/kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

HWY_ATTR void closest_pencil(const Target& target, Pencil& pencil, const RayStream& rays,
                             const Filter& filter, const HitStream& hits) {
    if (filter.trivial())
        ClosestPencil<false>(target, pencil, rays, filter, hits).trace();
    else
        ClosestPencil<true>(target, pencil, rays, filter, hits).trace();
}

HWY_ATTR void occluded_pencil(const Target& target, Pencil& pencil, const RayStream& rays,
                              const Filter& filter, uint8_t* occluded) {
    if (filter.trivial())
        OccludedPencil<false>(target, pencil, rays, filter).trace(occluded);
    else
        OccludedPencil<true>(target, pencil, rays, filter).trace(occluded);
}

constinit const PencilCalls kPencils = {closest_pencil, occluded_pencil};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
