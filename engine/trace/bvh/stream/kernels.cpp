// The kernels of the wide BVH, compiled once for each instruction set. The same operations in the
// same order as geometry/intersect.h wherever a hit is decided, so the same bits.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/stream/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/stream/kernels.h"

#if !PEREGRINE_PLAIN_TARGET // there the plain kernels do the work
#include "trace/bvh/stream/calls-inl.h"
#include "trace/bvh/stream/splitter-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

inline RayStream part_of(const RayStream& rays, uint32_t first, uint32_t count) {
    RayStream part = rays;
    for (int k = 0; k < 3; ++k) {
        part.origin[k] += first;
        part.direction[k] += first;
    }
    part.t_min += first;
    part.t_max += first;
    part.count = count;
    return part;
}

inline HitStream part_of(const HitStream& hits, uint32_t first) {
    return {hits.t + first,         hits.u + first,
            hits.v + first,         hits.triangle + first,
            hits.back_face + first, hits.steps ? hits.steps + first : nullptr};
}

HWY_ATTR void closest_hits(const Target& target, const RayStream& rays, const Filter& filter,
                           const HitStream& hits) {
    if (target.bounds.empty()) {
        for (uint32_t i = 0; i < rays.count; ++i) hits.store(i, miss(0));
        return;
    }
    if (rays.tile && kTiles.closest(target, rays, filter, hits)) return;
    Splitter(
        target, rays,
        [&](Beam& beam) HWY_ATTR {
            kBeams.closest(target, beam, rays, filter, hits);
            return true;
        },
        NoParallels(),
        [&](Pencil& pencil) HWY_ATTR { kPencils.closest(target, pencil, rays, filter, hits); },
        [&](uint32_t first, uint32_t count) HWY_ATTR {
            kWaveStreams.closest(target, part_of(rays, first, count), filter, part_of(hits, first));
        });
}

HWY_ATTR void are_occluded(const Target& target, const RayStream& rays, const Filter& filter,
                           uint8_t* result) {
    if (target.bounds.empty()) {
        std::fill_n(result, rays.count, uint8_t(0));
        return;
    }
    Splitter(
        target, rays,
        [&](Beam& beam) HWY_ATTR { return kBeams.occluded(target, beam, rays, filter, result); },
        [&](ParallelBeam& beam)
            HWY_ATTR { return kParallels.occluded(target, beam, rays, filter, result); },
        [&](Pencil& pencil) HWY_ATTR { kPencils.occluded(target, pencil, rays, filter, result); },
        [&](uint32_t first, uint32_t count) HWY_ATTR {
            kWaveStreams.occluded(target, part_of(rays, first, count), filter, result + first);
        });
}

[[maybe_unused]] constexpr StreamKernels kStreams = {closest_hits, are_occluded};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
#include "simd/select.h"

namespace peregrine::trace::bvh {

const StreamKernels* stream_kernels(base::Isa isa) {
    return PEREGRINE_TABLE_FOR(isa, kStreams);
}

} // namespace peregrine::trace::bvh
#endif
