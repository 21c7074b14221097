#pragma once

#include <bit>
#include <cstdint>

namespace peregrine::render::post {

// Linear light to 8-bit sRGB codes (IEC 61966-2-1) through a tone curve, equal to the exactly
// rounded value of the formulas. A code begins at a threshold. Floats are binned by their upper
// bits, 128 bins to an octave; a bin is at most 0.79 % wide and thresholds are at least 0.93 %
// apart (both curves gain at most 106 codes from a factor of e), so a bin holds one threshold at
// most. A table has, for each bin, a number to which a float's lower bits are added: the upper
// half of the sum is the code, since the lower bits carry into it from the threshold on.
class DisplayCurve {
public:
    // Built by the first call. Thread safe.
    static const DisplayCurve& clamp();  // cut at 1
    static const DisplayCurve& filmic(); // see filmic_tone()

    // NaN gives 0.
    uint8_t encode(float x) const {
        const float low = x > kLowest ? x : kLowest;
        const auto bits = std::bit_cast<uint32_t>(low < kHighest ? low : kHighest);
        return uint8_t((bins_[(bits >> kShift) - kFirstBin] + (bits & kLowerBits)) >> kShift);
    }

    // For the same with vectors.
    const uint32_t* bins() const { return bins_; }

    // Where the light that surfaces reflect is at least `dimmest`, and the part of it that they
    // reflect is at most one: at most so many steps of the display go to a unit of more of it.
    double most_steps(float dimmest) const;

    static constexpr float kLowest = 0x1p-13f; // code 0 on every curve
    static constexpr float kHighest = 8.0f;    // code 255
    static constexpr uint32_t kShift = 16;
    static constexpr uint32_t kLowerBits = (1u << kShift) - 1;
    static constexpr uint32_t kFirstBin = std::bit_cast<uint32_t>(kLowest) >> kShift;

private:
    static constexpr uint32_t kBins = (std::bit_cast<uint32_t>(kHighest) >> kShift) - kFirstBin + 1;

    // `inverse` gives the light that the curve maps to a linear value in (0, 1).
    explicit DisplayCurve(double (*inverse)(double));

    float threshold_[257]; // the smallest float that has the code
    uint32_t bins_[kBins];
};

// Narkowicz, "ACES Filmic Tone Mapping Curve", 2015; before it is cut at 1.
inline float filmic_tone(float x) {
    return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
}

} // namespace peregrine::render::post
