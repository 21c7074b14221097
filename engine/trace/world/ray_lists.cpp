// Compiled once for each instruction set.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/world/ray_lists.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/slabs.h"
#include "trace/world/ray_lists.h"

#include <algorithm>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, 8>;
using Numbers = hn::RebindToSigned<Lanes>;
constexpr Lanes kF;
constexpr Numbers kI;
constexpr hn::Rebind<RayNumber, Lanes> kN;
constexpr uint32_t kWidth = uint32_t(hn::MaxLanes(kF));

using VF = hn::Vec<Lanes>;

// Planes of boxes, each relative to the origin of a ray.
struct SixPlanes {
    VF lower[3], upper[3];
    VF farthest; // of them; 0 at first

    HWY_ATTR HWY_INLINE void place(int k, VF lower_, VF lower_rest, VF upper_, VF upper_rest) {
        lower[k] = hn::Add(lower_, lower_rest);
        upper[k] = hn::Add(upper_, upper_rest);
        farthest = hn::Max(farthest, hn::Max(hn::Abs(lower[k]), hn::Abs(upper[k])));
    }
    HWY_ATTR HWY_INLINE VF margin(VF margin, VF slope, VF distance) const {
        return hn::Add(hn::Add(margin, hn::Mul(slope, farthest)),
                       hn::Mul(hn::Set(kF, 0x1p-46f), distance));
    }
    HWY_ATTR HWY_INLINE void cut(int k, VF margin, VF inverse, VF& near, VF& far) const {
        const VF a = hn::Mul(hn::Sub(lower[k], margin), inverse);
        const VF b = hn::Mul(hn::Add(upper[k], margin), inverse);
        near = hn::Max(near, hn::Min(a, b));
        far = hn::Min(far, hn::Max(a, b));
    }
};

// Which of the rays that of(array) reads may meet the extent, a bit each.
template <class Of>
HWY_ATTR HWY_INLINE uint32_t meet(const accel::instances::Extent& extent, const GateStream& rays,
                                  const Of& of) {
    const auto m =
        hn::Add(hn::Set(kF, extent.margin), hn::Mul(hn::Set(kF, extent.slope), of(rays.distance)));
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
    return bytes[0];
}

// ... of an extent with rests: its planes relative to the origins, of which either is a sum of two
// floats. The margins grow with the distance to the farthest of them.
template <class Of>
HWY_ATTR HWY_INLINE uint32_t meet(const FarExtent& extent, const GateStream& rays, const Of& of) {
    const math::Box& box = extent.rounded.box;
    SixPlanes planes;
    planes.farthest = hn::Zero(kF);
    for (int k = 0; k < 3; ++k) {
        const auto origin = of(rays.origin[k]), rest = of(rays.rest[k]);
        planes.place(k, hn::Sub(hn::Set(kF, box.lower[k]), origin),
                     hn::Sub(hn::Set(kF, extent.lower[k]), rest),
                     hn::Sub(hn::Set(kF, box.upper[k]), origin),
                     hn::Sub(hn::Set(kF, extent.upper[k]), rest));
    }
    auto near = of(rays.t_min), far = of(rays.t_max);
    const auto m = planes.margin(hn::Set(kF, extent.margin), hn::Set(kF, extent.rounded.slope),
                                 of(rays.distance));
    for (int k = 0; k < 3; ++k) planes.cut(k, m, of(rays.inverse[k]), near, far);
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(kF, hn::Le(near, far), bytes);
    return bytes[0];
}

// Of `left` rays in lanes.
constexpr uint32_t bits_of(uint32_t left) {
    return left < kWidth ? (1u << left) - 1 : ~0u;
}

template <class Extent>
HWY_ATTR uint32_t enter(const Extent& extent, const GateStream& rays, const RayNumber* from,
                        uint32_t count, RayNumber* to) {
    uint32_t entered = 0;
    for (uint32_t i = 0; i < count; i += kWidth) {
        const auto number = hn::PromoteTo(kI, hn::LoadU(kN, from + i));
        const auto of = [&](const float* values) HWY_ATTR __attribute__((always_inline)) {
            return hn::GatherIndex(kF, values, number);
        };
        const uint32_t met = meet(extent, rays, of) & bits_of(count - i);
        RayNumber numbers[kWidth];
        hn::StoreU(hn::LoadU(kN, from + i), kN, numbers);
        for (uint32_t bits = met; bits; bits &= bits - 1)
            to[entered++] = numbers[uint32_t(__builtin_ctz(bits))];
    }
    return entered;
}

template <class Extent>
HWY_ATTR uint32_t enter_all(const Extent& extent, const GateStream& rays, uint32_t count,
                            RayNumber* to) {
    uint32_t entered = 0;
    for (uint32_t i = 0; i < count; i += kWidth) {
        const auto of = [&](const float* values) HWY_ATTR __attribute__((always_inline)) {
            return hn::Load(kF, values + i);
        };
        for (uint32_t bits = meet(extent, rays, of) & bits_of(count - i); bits; bits &= bits - 1)
            to[entered++] = RayNumber(i + uint32_t(__builtin_ctz(bits)));
    }
    return entered;
}

HWY_ATTR HWY_INLINE void store_entered(VF near, VF far, uint32_t first, EnteredNode& entered) {
    hn::Store(near, kF, entered.t_near + first);
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(kF, hn::Le(near, far), bytes);
    entered.children |= uint32_t(bytes[0]) << first;
}

// Of the children that are there; unusual rays enter them all.
HWY_ATTR HWY_INLINE void choose(const accel::instances::Node& node, const GateRay& ray,
                                EnteredNode& entered) {
    if (!ray.is_usual) [[unlikely]] {
        entered.children = ~0u;
        std::fill_n(entered.t_near, accel::instances::kWidth, ray.t_min);
    }
    entered.children &= (1u << node.count) - 1;
}

HWY_ATTR HWY_INLINE void meet_children(const accel::instances::Node& node, const GateRay& ray,
                                       float t_max, EnteredNode& entered) {
    entered.children = 0;
    for (uint32_t first = 0; first < accel::instances::kWidth; first += kWidth) {
        const auto m = hn::MulAdd(hn::Load(kF, node.slope + first), hn::Set(kF, ray.distance),
                                  hn::Load(kF, node.margin + first));
        auto near = hn::Set(kF, ray.t_min), far = hn::Set(kF, t_max);
        for (int k = 0; k < 3; ++k) {
            const auto origin = hn::Set(kF, ray.origin[k]), inverse = hn::Set(kF, ray.inverse[k]);
            const auto lower = hn::Sub(hn::Load(kF, node.lower[k] + first), m);
            const auto upper = hn::Add(hn::Load(kF, node.upper[k] + first), m);
            const auto a = hn::Mul(hn::Sub(lower, origin), inverse);
            const auto b = hn::Mul(hn::Sub(upper, origin), inverse);
            near = hn::Max(near, hn::Min(a, b));
            far = hn::Min(far, hn::Max(a, b));
        }
        store_entered(near, far, first, entered);
    }
    choose(node, ray, entered);
}

HWY_ATTR void enter_node_far(const accel::instances::Node& node,
                             const accel::instances::NodeRest& rest, const GateRay& ray,
                             float t_max, EnteredNode& entered) {
    entered.children = 0;
    for (uint32_t first = 0; first < accel::instances::kWidth; first += kWidth) {
        SixPlanes planes;
        planes.farthest = hn::Zero(kF);
        for (int k = 0; k < 3; ++k) {
            const auto origin = hn::Set(kF, ray.origin[k]), left = hn::Set(kF, ray.rest[k]);
            planes.place(k, hn::Sub(hn::Load(kF, node.lower[k] + first), origin),
                         hn::Sub(hn::Load(kF, rest.lower[k] + first), left),
                         hn::Sub(hn::Load(kF, node.upper[k] + first), origin),
                         hn::Sub(hn::Load(kF, rest.upper[k] + first), left));
        }
        auto near = hn::Set(kF, ray.t_min), far = hn::Set(kF, t_max);
        const auto m = planes.margin(hn::Load(kF, rest.margin + first),
                                     hn::Load(kF, node.slope + first), hn::Set(kF, ray.distance));
        for (int k = 0; k < 3; ++k) planes.cut(k, m, hn::Set(kF, ray.inverse[k]), near, far);
        store_entered(near, far, first, entered);
    }
    choose(node, ray, entered);
}

HWY_ATTR void enter_node(const accel::instances::Node& node, const GateRay& ray, float t_max,
                         EnteredNode& entered) {
    meet_children(node, ray, t_max, entered);
}

HWY_ATTR void enter_root(const accel::instances::Node& root, const math::Ray& ray, GateRay& gate,
                         EnteredNode& entered) {
    const float largest = largest_component(ray.direction), smallest = 0x1p-26f * largest;
    for (int k = 0; k < 3; ++k) {
        const float d = ray.direction[k];
        gate.origin[k] = ray.origin[k];
        gate.inverse[k] = 1 / (std::fabs(d) < smallest ? std::copysign(smallest, d) : d);
    }
    gate.distance = largest_component(ray.origin);
    gate.t_min = ray.t_min;
    gate.is_usual = largest >= 0x1p-32f && largest <= 0x1p32f && gate.distance <= 0x1p60f;
    meet_children(root, gate, ray.t_max, entered);
}

HWY_ATTR void look_at(const RayStream& rays, GateStream& gate) {
    const auto zero = hn::Zero(kF), one = hn::Set(kF, 1.0f);
    for (uint32_t i = 0; i < rays.count; i += kWidth) {
        auto largest = zero, distance = zero;
        for (int k = 0; k < 3; ++k) {
            largest = hn::Max(largest, hn::Abs(hn::LoadU(kF, rays.direction[k] + i)));
            distance = hn::Max(distance, hn::Abs(hn::LoadU(kF, rays.origin[k] + i)));
        }
        const auto usual = hn::And(
            hn::And(hn::Ge(largest, hn::Set(kF, 0x1p-32f)), hn::Le(largest, hn::Set(kF, 0x1p32f))),
            hn::Le(distance, hn::Set(kF, 0x1p60f)));
        const auto smallest = hn::Mul(largest, hn::Set(kF, 0x1p-26f));
        for (int k = 0; k < 3; ++k) {
            const auto d = hn::LoadU(kF, rays.direction[k] + i);
            const auto far_from_zero =
                hn::IfThenElse(hn::Lt(hn::Abs(d), smallest), hn::CopySign(smallest, d), d);
            hn::Store(hn::IfThenElseZero(usual, hn::Div(one, far_from_zero)), kF,
                      gate.inverse[k] + i);
            hn::Store(hn::IfThenElseZero(usual, hn::LoadU(kF, rays.origin[k] + i)), kF,
                      gate.origin[k] + i);
        }
        hn::Store(hn::IfThenElseZero(usual, distance), kF, gate.distance + i);
        const auto never = hn::Set(kF, -std::numeric_limits<float>::infinity());
        hn::Store(hn::IfThenElse(usual, hn::LoadU(kF, rays.t_min + i), never), kF, gate.t_min + i);
    }
}

using accel::instances::Extent;

constexpr RayLists kRayLists = {look_at,    enter_all<Extent>,    enter<Extent>,    enter_root,
                                enter_node, enter_all<FarExtent>, enter<FarExtent>, enter_node_far};

} // namespace peregrine::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/select.h"

namespace peregrine::trace {

const RayLists& ray_lists(base::Isa isa) {
    const auto* const table = PEREGRINE_TABLE_FOR(isa, kRayLists);
    // Otherwise the last one compiled: the machine's baseline.
    return table ? *table : HWY_NAMESPACE::kRayLists;
}

} // namespace peregrine::trace
#endif
