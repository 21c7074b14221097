#pragma once

#include <bit>
#include <cstdint>

namespace peregrine::render::post {

// IEEE 754 binary16, rounded to nearest, ties to even.
inline uint16_t to_half(float value) {
    const auto bits = std::bit_cast<uint32_t>(value);
    const uint32_t sign = bits >> 16 & 0x8000u;
    const uint32_t magnitude = bits & 0x7fffffffu;
    if (magnitude > 0x7f800000u) return uint16_t(sign | 0x7e00u);  // NaN
    if (magnitude >= 0x477ff000u) return uint16_t(sign | 0x7c00u); // rounds beyond 65504
    if (magnitude < 0x38800000u) {
        // Subnormal: adding 0.5 makes the float unit round to a multiple of 2^-24 for us.
        const float shifted = std::bit_cast<float>(magnitude) + 0.5f;
        return uint16_t(sign | (std::bit_cast<uint32_t>(shifted) - 0x3f000000u));
    }
    const uint32_t odd = magnitude >> 13 & 1;
    return uint16_t(sign | ((magnitude - 0x38000000u + 0xfffu + odd) >> 13));
}

} // namespace peregrine::render::post
