#pragma once

#include "math/ray.h"

#include <bit>
#include <cstdint>
#include <limits>

namespace peregrine::query {

inline constexpr float kLargestOrigin = 1e30f;
inline constexpr float kLargestFloat = std::numeric_limits<float>::max();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Magnitudes order as the integers that hold their bits, with infinity and NaN above all numbers.
inline constexpr uint32_t kMagnitude = 0x7fffffff;

constexpr uint32_t bits_of(float value) {
    return std::bit_cast<uint32_t>(value);
}

// Without branches: a single query spends more on this than on a few nodes otherwise.
inline bool is_valid(const math::Ray& ray) {
    const auto within = [](float value, float limit) {
        return (bits_of(value) & kMagnitude) <= bits_of(limit);
    };
    const math::Vec3 &o = ray.origin, &d = ray.direction;
    const bool origin =
        within(o.x, kLargestOrigin) & within(o.y, kLargestOrigin) & within(o.z, kLargestOrigin);
    const bool direction =
        within(d.x, kLargestFloat) & within(d.y, kLargestFloat) & within(d.z, kLargestFloat);
    const bool range = within(ray.t_min, kInfinity) & within(ray.t_max, kInfinity);
    const bool length = ((bits_of(d.x) | bits_of(d.y) | bits_of(d.z)) & kMagnitude) != 0;
    return origin & direction & range & length;
}

// For a ray that is not valid: says what is wrong.
[[noreturn, gnu::cold, gnu::noinline]] void reject(uint64_t index, const math::Ray& ray);

} // namespace peregrine::query
