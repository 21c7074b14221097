#include "scene/light_map.h"

#include <cmath>

namespace peregrine::scene {

uint32_t SharedExponent::encode(const math::Vec3& color) {
    constexpr float kLargest = float(kMost) / float(kMost + 1) * 65536.0f;
    float channel[3];
    for (int k = 0; k < 3; ++k) channel[k] = std::clamp(color[k], 0.0f, kLargest);
    const float largest = std::max({channel[0], channel[1], channel[2]});
    int exponent = 0;
    std::frexp(largest, &exponent); // largest < 2^exponent
    exponent = std::max(exponent, -kBias);
    if (std::floor(std::ldexp(largest, kBits - exponent) + 0.5f) > float(kMost)) ++exponent;
    uint32_t bits = uint32_t(exponent + kBias) << (3 * kBits);
    for (int k = 0; k < 3; ++k)
        bits |= uint32_t(std::floor(std::ldexp(channel[k], kBits - exponent) + 0.5f))
                << (k * kBits);
    return bits;
}

math::Vec3 SharedExponent::decode(uint32_t bits) {
    const int exponent = int(bits >> (3 * kBits)) - kBias - kBits;
    const auto channel = [&](int k) {
        return std::ldexp(float(bits >> (k * kBits) & kMost), exponent);
    };
    return {channel(0), channel(1), channel(2)};
}

} // namespace peregrine::scene
