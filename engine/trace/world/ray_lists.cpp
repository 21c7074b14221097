// Compiled once for each instruction set.
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/world/ray_lists.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/world/ray_lists.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, 8>;
using Numbers = hn::RebindToSigned<Lanes>;
constexpr Lanes kF;
constexpr Numbers kI;
constexpr hn::Rebind<RayNumber, Lanes> kN;
constexpr uint32_t kWidth = uint32_t(hn::MaxLanes(kF));

HWY_ATTR uint32_t enter(const accel::instances::Extent& extent, const GateStream& rays,
                        const RayNumber* from, uint32_t count, RayNumber* to) {
    const auto margin = hn::Set(kF, extent.margin), slope = hn::Set(kF, extent.slope);
    uint32_t entered = 0;
    for (uint32_t i = 0; i < count; i += kWidth) {
        const auto number = hn::PromoteTo(kI, hn::LoadU(kN, from + i));
        const auto of = [&](const float* values)
                            HWY_ATTR { return hn::GatherIndex(kF, values, number); };
        const auto m = hn::Add(margin, hn::Mul(slope, of(rays.distance)));
        auto near = of(rays.t_min), far = of(rays.t_max);
        for (int k = 0; k < 3; ++k) {
            const auto origin = of(rays.origin[k]), inverse = of(rays.inverse[k]);
            const auto lower = hn::Sub(hn::Set(kF, extent.box.lower[k]), m);
            const auto upper = hn::Add(hn::Set(kF, extent.box.upper[k]), m);
            const auto a = hn::Mul(hn::Sub(lower, origin), inverse);
            const auto b = hn::Mul(hn::Sub(upper, origin), inverse);
            near = hn::Max(near, hn::Min(a, b));
            far = hn::Min(far, hn::Max(a, b));
        }
        uint8_t bytes[8] = {};
        hn::StoreMaskBits(kF, hn::Le(near, far), bytes);
        const uint32_t lanes = count - i < kWidth ? (1u << (count - i)) - 1 : ~0u;
        RayNumber numbers[kWidth];
        hn::StoreU(hn::LoadU(kN, from + i), kN, numbers);
        for (uint32_t bits = bytes[0] & lanes; bits; bits &= bits - 1)
            to[entered++] = numbers[uint32_t(__builtin_ctz(bits))];
    }
    return entered;
}

constexpr RayLists kRayLists = {enter};

} // namespace peregrine::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/simd_select.h"

namespace peregrine::trace {

const RayLists& ray_lists(base::Isa isa) {
    const auto* const table = PEREGRINE_TABLE_FOR(isa, kRayLists);
    // Otherwise the last one compiled: the machine's baseline.
    return table ? *table : HWY_NAMESPACE::kRayLists;
}

} // namespace peregrine::trace
#endif
