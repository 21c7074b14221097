#include "query/ray_order.h"

#include "math/box.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace peregrine::query {
namespace {

constexpr uint64_t kFewest = 4096; // rays: less are not worth a sort
constexpr uint32_t kSamples = 64;

// Calls look(i) for some of `count` rays from `first` on.
template <class Look>
void sample(uint64_t first, uint64_t count, Look&& look) {
    const uint64_t step = std::max<uint64_t>(count / kSamples, 1);
    for (uint64_t i = 0; i < count; i += step) look(first + i);
}

float largest_of(const math::Vec3& v) {
    return std::max({v.x, v.y, v.z});
}

uint32_t octant_of(const math::Vec3& d) {
    const auto sign = [](float x) { return std::bit_cast<uint32_t>(x) >> 31; };
    return sign(d.x) | sign(d.y) << 1 | sign(d.z) << 2;
}

} // namespace

bool are_scattered(const Rays& rays, uint64_t first, uint64_t end) {
    if (end - first < kFewest) return false;
    math::Box bounds;
    float steps = 0; // how far from one ray to the next
    uint32_t count = 0;
    sample(first, end - first - 1, [&](uint64_t i) {
        const math::Vec3 a = rays.own_origin(i), b = rays.own_origin(i + 1);
        bounds.extend(a);
        steps += largest_of(glm::abs(b - a));
        ++count;
    });
    return steps > float(count) / 16 * largest_of(bounds.upper - bounds.lower);
}

void RayOrder::sort(const Rays& rays, uint64_t first, uint32_t count) {
    math::Box bounds;
    sample(first, count, [&](uint64_t i) { bounds.extend(rays.own_origin(i)); });
    const math::Vec3 scale = float(kCells) / (bounds.upper - bounds.lower);
    // Bits of x, y and z in turns. What is beyond the sample belongs to the cells at its rim.
    constexpr uint16_t kSpread[kCells] = {0, 1, 8, 9, 64, 65, 72, 73};
    const auto spread_cell = [&](float along) -> uint32_t {
        constexpr float kLast = kCells - 1;
        return kSpread[along > 0 ? int(along < kLast ? along : kLast) : 0]; // NaN: 0
    };
    std::fill_n(place_, kKeys, 0u);
    for (uint32_t i = 0; i < count; ++i) {
        const math::Vec3 at = (rays.own_origin(first + i) - bounds.lower) * scale;
        const uint32_t cell = spread_cell(at.x) | spread_cell(at.y) << 1 | spread_cell(at.z) << 2;
        key_[i] = uint16_t(octant_of(rays.direction(first + i)) * (kKeys / 8) + cell);
        ++place_[key_[i]];
    }
    uint32_t next = 0;
    for (uint32_t& place : place_) next += std::exchange(place, next);
    for (uint32_t i = 0; i < count; ++i) order_[place_[key_[i]]++] = uint16_t(i);
}

} // namespace peregrine::query
