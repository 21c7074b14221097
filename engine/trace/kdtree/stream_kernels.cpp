// The packet kernels, compiled once for each instruction set: a packet is as many rays as a vector
// has floats. Same operations in the same order as geometry/intersect.h and trace/kdtree/single.h,
// so the same bits.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/kdtree/stream_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/kdtree/stream_kernels.h"

#if !PEREGRINE_PLAIN_TARGET // there the single-ray kernels do the work
#include "trace/kdtree/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::kdtree::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

template <bool Filtered>
HWY_ATTR void closest_stream(const Target& target, const RayStream& rays, const Filter& filter,
                             const HitStream& hits) {
    for (uint32_t first = 0; first < rays.count; first += kLanes8)
        ClosestPacket<Filtered>(target, filter, rays, first).trace(hits);
}

template <bool Filtered>
HWY_ATTR void occluded_stream(const Target& target, const RayStream& rays, const Filter& filter,
                              uint8_t* occluded) {
    for (uint32_t first = 0; first < rays.count; first += kLanes8)
        OccludedPacket<Filtered>(target, filter, rays, first).trace(occluded);
}

HWY_ATTR void closest(const Target& target, const RayStream& rays, const Filter& filter,
                      const HitStream& hits) {
    filter.trivial() ? closest_stream<false>(target, rays, filter, hits)
                     : closest_stream<true>(target, rays, filter, hits);
}

HWY_ATTR void occluded(const Target& target, const RayStream& rays, const Filter& filter,
                       uint8_t* result) {
    filter.trivial() ? occluded_stream<false>(target, rays, filter, result)
                     : occluded_stream<true>(target, rays, filter, result);
}

[[maybe_unused]] constexpr StreamKernels kStreamKernels = {closest, occluded};

} // namespace peregrine::trace::kdtree::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
#include "simd/select.h"

namespace peregrine::trace::kdtree {

const StreamKernels* stream_kernels(base::Isa isa) {
    return PEREGRINE_TABLE_FOR(isa, kStreamKernels);
}

} // namespace peregrine::trace::kdtree
#endif
