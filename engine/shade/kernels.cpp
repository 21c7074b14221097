// The shading loops, compiled once for each instruction set.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "shade/air/airlight-inl.h"
#include "shade/air/fog-inl.h"
#include "shade/baked/recall_light-inl.h"
#include "shade/blocks/blocks-inl.h"
#include "shade/kernels.h"
#include "shade/light/directional-inl.h"
#include "shade/light/point-inl.h"
#include "shade/light/recall-inl.h"
#include "shade/light/spot-inl.h"
#include "shade/light/weigh-inl.h"
#include "shade/material/highlight-inl.h"
#include "shade/material/matt-inl.h"
#include "shade/material/radiance-inl.h"
#include "shade/path/split-inl.h"
#include "shade/sky/sky-inl.h"
#include "shade/surface/surfaces-inl.h"

#include <utility>

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

template <class... Items>
struct List {};

// In the order of Program and of scene::LightType.
using Programs = List<Matt, Highlight>;
using LightKinds = List<PointLight, SpotLight, DirectionalLight>;

template <class Kind, scene::Falloff Law, class... Program>
constexpr ByProgram<WeighLight> weigh_by_program(List<Program...>) {
    return {weigh_light<Kind, Law, Program>...};
}

// All laws are one to light that comes from no place.
template <class Kind, size_t... Law>
constexpr WeighLights weigh_by_law(std::index_sequence<Law...>) {
    constexpr auto kOne = scene::Falloff::inverse_square;
    return {weigh_by_program < Kind,
            Kind::kHasPlace ? scene::Falloff(Law) : kOne > (Programs())...};
}

template <class... Kind>
constexpr std::array<WeighLights, sizeof...(Kind)> weigh_by_kind(List<Kind...>) {
    return {weigh_by_law<Kind>(std::make_index_sequence<scene::kFalloffCount>())...};
}

template <class... Program>
constexpr ByProgram<AddLight> add_by_program(List<Program...>) {
    return {add_light<Program>...};
}

template <Surroundings From, bool Emissive, class... Program>
constexpr ByProgram<FindRadiance> radiance_by_program(List<Program...>) {
    return {find_radiance<Program, From, Emissive>...};
}

template <Surroundings From>
constexpr std::array<ByProgram<FindRadiance>, 2> radiance_by_emission() {
    return {radiance_by_program<From, false>(Programs()),
            radiance_by_program<From, true>(Programs())};
}

template <bool Spot, size_t... Law>
constexpr AddUpAirlight airlight_by_law(std::index_sequence<Law...>) {
    return {add_up_airlight<Spot, scene::Falloff(Law)>...};
}

constexpr Kernels kKernels = {
    {find_surfaces<SurfacePart::all>, find_surfaces<SurfacePart::geometry>,
     find_surfaces<SurfacePart::colors>, find_surfaces<SurfacePart::geometry>},
    recall,
    recall_openness,
    recall_bounced,
    weigh_by_kind(LightKinds()),
    add_by_program(Programs()),
    {radiance_by_emission<Surroundings::even>(), radiance_by_emission<Surroundings::hidden>(),
     radiance_by_emission<Surroundings::bright>()},
    block_is_smooth,
    interpolate_block,
    paint_sky,
    find_clear,
    veil,
    bound_rays,
    list_ways,
    place_points,
    {airlight_by_law<false>(std::make_index_sequence<scene::kFalloffCount>()),
     airlight_by_law<true>(std::make_index_sequence<scene::kFalloffCount>())},
    {split_paths<false>, split_paths<true>},
    absorb,
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
