// The kernels of the wide BVH, compiled once for each instruction set. The same operations in the
// same order as geometry/intersect.h wherever a hit is decided, so the same bits.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/simd_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/simd_kernels.h"

#if HWY_TARGET != HWY_SCALAR // there the plain kernels do the work
#include "trace/bvh/beam_kernels-inl.h"
#include "trace/bvh/pencil_kernels-inl.h"
#include "trace/bvh/single-inl.h"
#include "trace/bvh/splitter-inl.h"
#include "trace/bvh/wave_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

template <class View>
HWY_ATTR Hit closest_hit(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return miss(0);
    return filter.trivial() ? closest<View, false>(target, ray, filter)
                            : closest<View, true>(target, ray, filter);
}

template <class View>
HWY_ATTR bool is_occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return false;
    return filter.trivial() ? occluded<View, false>(target, ray, filter)
                            : occluded<View, true>(target, ray, filter);
}

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

template <bool Filtered>
HWY_ATTR void closest_stream(const Target& target, const RayStream& rays, const Filter& filter,
                             const HitStream& hits) {
    Splitter(
        target, rays,
        [&](Beam& beam) HWY_ATTR {
            ClosestBeam<Filtered>(target, beam, rays, filter, hits).trace();
            return true;
        },
        [&](Pencil& pencil)
            HWY_ATTR { ClosestPencil<Filtered>(target, pencil, rays, filter, hits).trace(); },
        [&](uint32_t first, uint32_t count) HWY_ATTR {
            closest_wave<Filtered>(target, part_of(rays, first, count), filter,
                                   part_of(hits, first));
        });
}

template <bool Filtered>
HWY_ATTR void occluded_stream(const Target& target, const RayStream& rays, const Filter& filter,
                              uint8_t* result) {
    Splitter(
        target, rays,
        [&](Beam& beam)
            HWY_ATTR { return OccludedBeam<Filtered>(target, beam, rays, filter).trace(result); },
        [&](Pencil& pencil)
            HWY_ATTR { OccludedPencil<Filtered>(target, pencil, rays, filter).trace(result); },
        [&](uint32_t first, uint32_t count) HWY_ATTR {
            occluded_wave<Filtered>(target, part_of(rays, first, count), filter, result + first);
        });
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

template <class View>
constexpr Kernels make_table() {
    return {closest_hit<View>, is_occluded<View>, closest_hits,
            are_occluded,      visit<View>,       base::Isa::best};
}
[[maybe_unused]] constexpr Kernels kKernels = make_table<FullView>();
[[maybe_unused]] constexpr Kernels kCompactKernels = make_table<CompactView>();

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
#include "simd/select.h"

namespace peregrine::trace::bvh {

const Kernels* simd_kernels(base::Isa isa, bool compact) {
    return compact ? PEREGRINE_TABLE_FOR(isa, kCompactKernels) : PEREGRINE_TABLE_FOR(isa, kKernels);
}

} // namespace peregrine::trace::bvh
#endif
