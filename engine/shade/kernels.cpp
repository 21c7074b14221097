// The shading loops, compiled once for each instruction set.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "shade/kernels.h"
#include "shade/lights-inl.h"
#include "shade/recall-inl.h"
#include "shade/surfaces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

using scene::Falloff;
using scene::LightType;

template <LightType Type, Falloff Kind>
constexpr std::array<WeighLight, 2> weigh_light_of() {
    return {weigh_light<Type, Kind, false>, weigh_light<Type, Kind, true>};
}

template <LightType Type>
constexpr WeighLights weigh_lights() {
    return {weigh_light_of<Type, Falloff::schlick_linear>(),
            weigh_light_of<Type, Falloff::linear>(), weigh_light_of<Type, Falloff::cosine_linear>(),
            weigh_light_of<Type, Falloff::windowed_inverse_square>(),
            weigh_light_of<Type, Falloff::inverse_square>()};
}

// The same from everywhere: one kernel serves all rows.
template <>
constexpr WeighLights weigh_lights<LightType::directional>() {
    constexpr auto row = weigh_light_of<LightType::directional, Falloff::inverse_square>();
    return {row, row, row, row, row};
}
constexpr Kernels kKernels = {
    find_surfaces,
    recall,
    {weigh_lights<LightType::point>(), weigh_lights<LightType::spot>(),
     weigh_lights<LightType::directional>()},
    {add_light<false>, add_light<true>},
    {{combine<false, false>, combine<false, true>}, {combine<true, false>, combine<true, true>}},
};

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/select.h"

namespace peregrine::shade {

const Kernels& kernels(base::Isa isa) {
    const auto* const table = PEREGRINE_TABLE_FOR(isa, kKernels);
    // Otherwise the last one compiled: the machine's baseline.
    return table ? *table : HWY_NAMESPACE::kKernels;
}

} // namespace peregrine::shade
#endif
