#pragma once

#include <cstdint>
#include <vector>

namespace peregrine::test {

// The error that a viewer sees when two pictures are shown in turns at one place, 0 to 1 a pixel.
struct FlipMap {
    uint32_t width, height;
    std::vector<float> errors; // row by row

    double mean() const;
    double worst_tile(uint32_t size) const; // the highest mean of the tiles of size x size pixels
};

// Of a display of 3840 pixels on 0.7 m, looked at from 0.7 m.
inline constexpr float kFlipPixelsPerDegree = 67.0206f;

// LDR-FLIP (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: "FLIP: A Difference
// Evaluator for Alternating Images", HPG 2020). Pictures are RGBA, sRGB-encoded, 8 bits a channel,
// without gaps; alpha is not looked at.
FlipMap flip(const uint8_t* reference, const uint8_t* test, uint32_t width, uint32_t height,
             float pixels_per_degree = kFlipPixelsPerDegree);

} // namespace peregrine::test
