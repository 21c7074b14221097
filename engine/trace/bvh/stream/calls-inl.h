// The kernels of an instruction set, each compiled by the kernels.cpp of its room. Included once
// for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_STREAM_CALLS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_STREAM_CALLS_INL_H
#undef PEREGRINE_TRACE_BVH_STREAM_CALLS_INL_H
#else
#define PEREGRINE_TRACE_BVH_STREAM_CALLS_INL_H
#endif

#include <hwy/highway.h>

#include "trace/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

struct Beam;
struct Pencil;

// For a target that is not empty. Rays alone, with the full tree or the compact one:
HWY_ATTR Hit closest_full(const Target& target, const math::Ray& ray, const Filter& filter);
HWY_ATTR Hit closest_compact(const Target& target, const math::Ray& ray, const Filter& filter);
HWY_ATTR bool occluded_full(const Target& target, const math::Ray& ray, const Filter& filter);
HWY_ATTR bool occluded_compact(const Target& target, const math::Ray& ray, const Filter& filter);
HWY_ATTR void visit_full(const Target& target, const math::Ray& ray, Visitor& visitor);
HWY_ATTR void visit_compact(const Target& target, const math::Ray& ray, Visitor& visitor);

// Rays of the stream that were gathered; false: these had better not be a beam, and nothing is
// known of them.
HWY_ATTR void closest_beam(const Target& target, Beam& beam, const RayStream& rays,
                           const Filter& filter, const HitStream& hits);
HWY_ATTR bool occluded_beam(const Target& target, Beam& beam, const RayStream& rays,
                            const Filter& filter, uint8_t* occluded);
HWY_ATTR void closest_pencil(const Target& target, Pencil& pencil, const RayStream& rays,
                             const Filter& filter, const HitStream& hits);
HWY_ATTR void occluded_pencil(const Target& target, Pencil& pencil, const RayStream& rays,
                              const Filter& filter, uint8_t* occluded);

// All rays of a stream.
HWY_ATTR void closest_wave(const Target& target, const RayStream& rays, const Filter& filter,
                           const HitStream& hits);
HWY_ATTR void occluded_wave(const Target& target, const RayStream& rays, const Filter& filter,
                            uint8_t* occluded);

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
