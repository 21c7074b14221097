#pragma once

#include <cstdint>

// What a texture of roughness and metalness makes of a matt surface with a highlight.
namespace peregrine::shade {

inline constexpr float kMostShininess = 512;
inline constexpr float kLeastRoughness = 0.24975650f; // what is smoother has that shininess
inline constexpr float kRoughnessFade = 0.8f; // highlights lose so much of their colour at 1
inline constexpr float kMetalLoss = 0.5f; // of a metal's colour as a matt surface: not all of it,
                                          // as it mirrors nothing where it is rough

// The exponent of the highlight: as wide as a Beckmann distribution of alpha = roughness^2 (Walter
// et al. 2007, section 5.1), 2 / alpha^2 - 2, from 1 to kMostShininess.
float shininess_of(float roughness);

// highlight_gain() of that at even steps of roughness, between which it is interpolated: off by
// less than 0.5% (unit_test, Wear.GainsAreInterpolatedClosely).
struct GainTable {
    static constexpr uint32_t kCells = 256; // from kLeastRoughness to 1

    float gain[kCells + 1];
};
const GainTable& gain_table();

} // namespace peregrine::shade
