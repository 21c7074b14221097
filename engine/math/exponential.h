#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace peregrine::math {

// As shade/path/fresnel-inl.h has it for vectors: exp(-x) for x >= 0, to 1e-5 of it, with the same
// bits everywhere; 0 from 87 on.
inline float exp_of_minus(float x) {
    const float y = x * -1.44269504f;
    if (!(y > -126.0f)) return 0;
    const float whole = std::floor(y + 0.5f);
    const float part = (y - whole) * 0.69314718f; // -0.35 to 0.35
    float sum = 1.0f / 720;
    for (const float factor : {1.0f / 120, 1.0f / 24, 1.0f / 6, 1.0f / 2, 1.0f, 1.0f})
        sum = sum * part + factor;
    return sum * std::bit_cast<float>(uint32_t(int32_t(whole) + 127) << 23);
}

} // namespace peregrine::math
