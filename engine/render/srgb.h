#pragma once

#include <cstdint>

namespace peregrine::render {

// Linear light to 8-bit sRGB (IEC 61966-2-1), equal to the exactly rounded value. A code begins at
// a threshold; thresholds are at least 3.03e-4 apart (the linear part's 1 / (255 * 12.92); above it
// the curve's slope only falls), so a cell of width 1/4096 = 2.44e-4 holds one at most: a table
// gives the code at the cell's lower end, a comparison does the rest.
class SrgbEncoder {
public:
    // Built by the first call. Thread safe.
    static const SrgbEncoder& get();

    // NaN gives 0.
    uint8_t encode(float linear) const {
        const float x = linear > 0.0f ? (linear < 1.0f ? linear : 1.0f) : 0.0f;
        const uint32_t code = first_code_[uint32_t(x * float(kCells))];
        return uint8_t(code + (x >= threshold_[code + 1]));
    }

private:
    static constexpr uint32_t kCells = 4096;

    SrgbEncoder();

    float threshold_[257]; // the smallest float that has the code
    uint8_t first_code_[kCells + 1];
};

} // namespace peregrine::render
