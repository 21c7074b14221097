// The shading loops, compiled once for each instruction set.
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "shade/kernels.h"
#include "shade/lights-inl.h"
#include "shade/surfaces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using scene::LightType;

constexpr Kernels kKernels = {
    find_surfaces,
    {{weigh_light<LightType::point, false>, weigh_light<LightType::point, true>},
     {weigh_light<LightType::spot, false>, weigh_light<LightType::spot, true>},
     {weigh_light<LightType::directional, false>, weigh_light<LightType::directional, true>}},
    {add_light<false>, add_light<true>},
    {{combine<false, false>, combine<false, true>}, {combine<true, false>, combine<true, true>}},
};

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace peregrine::shade {

const Kernels& kernels(base::Isa isa) {
    switch (isa) {
#if HWY_TARGETS & HWY_SSE4
    case base::Isa::sse4:
        return N_SSE4::kKernels;
#endif
#if HWY_TARGETS & HWY_AVX2
    case base::Isa::avx2:
        return N_AVX2::kKernels;
#endif
#if HWY_TARGETS & HWY_AVX3
    case base::Isa::avx512:
        return N_AVX3::kKernels;
#endif
#if HWY_TARGETS & HWY_NEON
    case base::Isa::neon:
        return N_NEON::kKernels;
#endif
    default:
        return HWY_NAMESPACE::kKernels; // the last target compiled: the machine's baseline;
    }
}

} // namespace peregrine::shade
#endif
