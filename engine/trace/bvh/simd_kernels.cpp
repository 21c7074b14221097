// The kernels of the wide BVH, compiled once for each instruction set. The same operations in the
// same order as geometry/intersect.h wherever a hit is decided, so the same bits.
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/simd_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/simd_kernels.h"

#if HWY_TARGET != HWY_SCALAR // there the plain kernels do the work
#include "trace/bvh/beam_kernels-inl.h"
#include "trace/bvh/single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

HWY_ATTR Hit closest_hit(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return miss(0);
    return filter.trivial() ? closest<false>(target, ray, filter)
                            : closest<true>(target, ray, filter);
}

HWY_ATTR bool is_occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return false;
    return filter.trivial() ? occluded<false>(target, ray, filter)
                            : occluded<true>(target, ray, filter);
}

// Rays with a common origin go as beams: as many at a time as make one, halves where they do not.
template <class Beams, class Single>
HWY_ATTR void split_into_beams(const Target& target, const RayStream& rays, uint32_t first,
                               uint32_t count, Beams&& trace, Single&& trace_one) {
    Beam beam;
    if (count > kGroupRays / 2 && beam.gather(target, rays, first, count)) return trace(beam);
    if (count <= kGroupRays) {
        for (uint32_t i = first; i < first + count; ++i) trace_one(i);
        return;
    }
    const uint32_t half = (count / 2 + kGroupRays - 1) / kGroupRays * kGroupRays;
    split_into_beams(target, rays, first, half, trace, trace_one);
    split_into_beams(target, rays, first + half, count - half, trace, trace_one);
}

template <bool Filtered>
HWY_ATTR void closest_stream(const Target& target, const RayStream& rays, const Filter& filter,
                             const HitStream& hits) {
    for (uint32_t first = 0; first < rays.count; first += kBeamRays)
        split_into_beams(
            target, rays, first, std::min(kBeamRays, rays.count - first),
            [&](Beam& beam)
                HWY_ATTR { ClosestBeam<Filtered>(target, beam, rays, filter, hits).trace(); },
            [&](uint32_t i)
                HWY_ATTR { hits.store(i, closest<Filtered>(target, ray_at(rays, i), filter)); });
}

template <bool Filtered>
HWY_ATTR void occluded_stream(const Target& target, const RayStream& rays, const Filter& filter,
                              uint8_t* result) {
    for (uint32_t first = 0; first < rays.count; first += kBeamRays)
        split_into_beams(
            target, rays, first, std::min(kBeamRays, rays.count - first),
            [&](Beam& beam)
                HWY_ATTR { OccludedBeam<Filtered>(target, beam, rays, filter).trace(result); },
            [&](uint32_t i)
                HWY_ATTR { result[i] = occluded<Filtered>(target, ray_at(rays, i), filter); });
}

HWY_ATTR void closest_hits(const Target& target, const RayStream& rays, const Filter& filter,
                           const HitStream& hits) {
    if (target.bounds.empty())
        for (uint32_t i = 0; i < rays.count; ++i) hits.store(i, miss(0));
    else
        filter.trivial() ? closest_stream<false>(target, rays, filter, hits)
                         : closest_stream<true>(target, rays, filter, hits);
}

HWY_ATTR void are_occluded(const Target& target, const RayStream& rays, const Filter& filter,
                           uint8_t* result) {
    if (target.bounds.empty())
        std::fill_n(result, rays.count, uint8_t(0));
    else
        filter.trivial() ? occluded_stream<false>(target, rays, filter, result)
                         : occluded_stream<true>(target, rays, filter, result);
}

template <base::Isa Set>
inline constexpr Kernels kKernels = {closest_hit, is_occluded, closest_hits, are_occluded, Set};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace peregrine::trace::bvh {

const Kernels* simd_kernels(base::Isa isa) {
    switch (isa) {
#if HWY_TARGETS & HWY_SSE4
    case base::Isa::sse4:
        return &N_SSE4::kKernels<base::Isa::sse4>;
#endif
#if HWY_TARGETS & HWY_AVX2
    case base::Isa::avx2:
        return &N_AVX2::kKernels<base::Isa::avx2>;
#endif
#if HWY_TARGETS & HWY_AVX3
    case base::Isa::avx512:
        return &N_AVX3::kKernels<base::Isa::avx512>;
#endif
#if HWY_TARGETS & HWY_NEON
    case base::Isa::neon:
        return &N_NEON::kKernels<base::Isa::neon>;
#endif
    default:
        return nullptr;
    }
}

} // namespace peregrine::trace::bvh
#endif
