#pragma once

#include <cstdint>

namespace peregrine::shade {

// A square of a tile's rays: `first` and the side^2 - 1 after it, along Morton's curve.
struct Block {
    uint16_t first;
    uint8_t side;              // 4, 8 or 16
    uint16_t known = kNothing; // what is known of its lights: index in TileLight::known

    static constexpr uint16_t kNothing = 0xffff;
    static constexpr uint32_t kLeast = 4;
    static constexpr uint32_t kMost = 16;

    uint32_t size() const { return uint32_t(side) * side; }
    uint32_t last() const { return first + size() - 1u; }
    Block quarter(uint32_t k) const {
        return {uint16_t(first + k * (size() / 4)), uint8_t(side / 2), known};
    }

    // The rays where light is tried: four corners, x first, and one in the middle, at
    // ((side / 2 - 1), (side / 2 - 1)).
    static constexpr uint32_t kSamples = 5;
    static constexpr uint32_t kMiddle = 4;
    uint32_t sample(uint32_t k) const {
        const uint32_t across = size() / 3; // Morton index of (side - 1, 0)
        const uint32_t place[kSamples] = {0, across, 2 * across, 3 * across, size() / 4 - 1};
        return first + place[k];
    }
};

} // namespace peregrine::shade
