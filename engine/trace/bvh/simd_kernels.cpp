// The kernels of the wide BVH, compiled once for each instruction set. The same operations in the
// same order as geometry/intersect.h wherever a hit is decided, so the same bits.
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/simd_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/simd_kernels.h"

#if HWY_TARGET != HWY_SCALAR // there the plain kernels do the work
#include "trace/bvh/single-inl.h"
#include "trace/each.h"

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

template <base::Isa Set>
inline constexpr Kernels kKernels = {closest_hit, is_occluded, closest_each<closest_hit>,
                                     occluded_each<is_occluded>, Set};

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
