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
#include "base/simd_select.h"

namespace peregrine::shade {

const Kernels& kernels(base::Isa isa) {
    const auto* const table = PEREGRINE_TABLE_FOR(isa, kKernels);
    // Otherwise the last one compiled: the machine's baseline.
    return table ? *table : HWY_NAMESPACE::kKernels;
}

} // namespace peregrine::shade
#endif
