// Waves, compiled once for each instruction set. Where a vector has less than eight floats rays go
// one by one.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/wave/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/stream/calls-inl.h"

#if !PEREGRINE_PLAIN_TARGET // there the plain kernels do the work
#include "trace/bvh/wave/wave-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
template <bool Filtered>
HWY_ATTR void closest_waves(const Target& target, const RayStream& rays, const Filter& filter,
                            const HitStream& hits) {
    const hn::RebindToUnsigned<D8> u8;
    for (uint32_t i = 0; i < rays.count; i += 8) {
        hn::StoreU(hn::Set(k8, std::numeric_limits<float>::infinity()), k8, hits.t + i);
        hn::StoreU(hn::Zero(k8), k8, hits.u + i);
        hn::StoreU(hn::Zero(k8), k8, hits.v + i);
        hn::StoreU(hn::Set(u8, geometry::kNoTriangle), u8, hits.triangle + i);
        hn::StoreU(hn::Zero(u8), u8, hits.back_face + i);
        if (hits.steps) hn::StoreU(hn::Zero(u8), u8, hits.steps + i);
    }
    Wave<false, Filtered> wave(target, filter);
    for (uint32_t first = 0; first < rays.count; first += kWaveStream)
        wave.trace(
            rays, first, std::min(kWaveStream, rays.count - first),
            [&](uint32_t i) HWY_ATTR {
                hits.store(i, closest_in_double<Filtered>(target, ray_at(rays, i), filter));
            },
            [&](uint32_t i, const Hit& hit) HWY_ATTR {
                hits.t[i] = hit.t;
                hits.u[i] = hit.u;
                hits.v[i] = hit.v;
                hits.triangle[i] = hit.triangle;
                hits.back_face[i] = hit.back_face;
            },
            [&](uint32_t i, uint32_t steps) HWY_ATTR {
                if (hits.steps && steps) hits.steps[i] = steps;
            });
}

template <bool Filtered>
HWY_ATTR void occluded_waves(const Target& target, const RayStream& rays, const Filter& filter,
                             uint8_t* occluded) {
    std::fill_n(occluded, rays.count, uint8_t(0));
    Wave<true, Filtered> wave(target, filter);
    for (uint32_t first = 0; first < rays.count; first += kWaveStream)
        wave.trace(
            rays, first, std::min(kWaveStream, rays.count - first),
            [&](uint32_t i) HWY_ATTR {
                occluded[i] = occluded_in_double<Filtered>(target, ray_at(rays, i), filter);
            },
            [&](uint32_t i, bool hit) HWY_ATTR { occluded[i] |= uint8_t(hit); },
            [](uint32_t, uint32_t) {});
}

HWY_ATTR void closest_wave(const Target& target, const RayStream& rays, const Filter& filter,
                           const HitStream& hits) {
    if (filter.trivial())
        closest_waves<false>(target, rays, filter, hits);
    else
        closest_waves<true>(target, rays, filter, hits);
}

HWY_ATTR void occluded_wave(const Target& target, const RayStream& rays, const Filter& filter,
                            uint8_t* occluded) {
    if (filter.trivial())
        occluded_waves<false>(target, rays, filter, occluded);
    else
        occluded_waves<true>(target, rays, filter, occluded);
}
#else
HWY_ATTR void closest_wave(const Target& target, const RayStream& rays, const Filter& filter,
                           const HitStream& hits) {
    const auto closest = (tree_of(target).is_compact() ? kCompactSingles : kSingles).closest;
    for (uint32_t i = 0; i < rays.count; ++i)
        hits.store(i, closest(target, ray_at(rays, i), filter));
}

HWY_ATTR void occluded_wave(const Target& target, const RayStream& rays, const Filter& filter,
                            uint8_t* result) {
    const auto occluded = (tree_of(target).is_compact() ? kCompactSingles : kSingles).occluded;
    for (uint32_t i = 0; i < rays.count; ++i) result[i] = occluded(target, ray_at(rays, i), filter);
}
#endif

constinit const StreamKernels kWaveStreams = {closest_wave, occluded_wave};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
