#pragma once

#include "math/ray.h"

#include <bit>
#include <cmath>
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

inline bool is_valid(const math::Ray& ray) {
    const auto within = [](float value, float limit) {
        return (bits_of(value) & kMagnitude) <= bits_of(limit);
    };
    const math::Vec3 &o = ray.origin, &d = ray.direction;
    return within(o.x, kLargestOrigin) && within(o.y, kLargestOrigin) && within(o.z, kLargestOrigin)
           && within(d.x, kLargestFloat) && within(d.y, kLargestFloat) && within(d.z, kLargestFloat)
           && within(ray.t_min, kInfinity) && within(ray.t_max, kInfinity)
           && ((bits_of(d.x) | bits_of(d.y) | bits_of(d.z)) & kMagnitude) != 0;
}

// Never true for a ray that is not valid, and half the work, which a single query feels: a sum of
// magnitudes is not below any of them, and NaN if one of them is.
inline bool is_surely_valid(const math::Ray& ray) {
    const math::Vec3 &o = ray.origin, &d = ray.direction;
    const float origin = (std::fabs(o.x) + std::fabs(o.y)) + std::fabs(o.z);
    const float direction = (std::fabs(d.x) + std::fabs(d.y)) + std::fabs(d.z);
    return origin <= kLargestOrigin && direction > 0 && direction <= kLargestFloat
           && !std::isunordered(ray.t_min, ray.t_max);
}

// For a ray that is not valid: says what is wrong.
[[noreturn, gnu::cold, gnu::noinline]] void reject(uint64_t index, const math::Ray& ray);

[[gnu::cold, gnu::noinline]] void check_closely(uint64_t index, const math::Ray& ray);

// Throws base::Error invalid_argument that names the ray if it is not valid.
inline void check_ray(uint64_t index, const math::Ray& ray) {
    if (!is_surely_valid(ray)) [[unlikely]]
        check_closely(index, ray);
}

} // namespace peregrine::query
