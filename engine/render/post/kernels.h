#pragma once

#include "base/isa.h"
#include "render/frame.h"
#include "render/post/display_curve.h"

#include <cstddef>
#include <cstdint>

namespace peregrine::render::post {

// A row of a film for edges, and where its neighbours are, in elements.
struct EdgeRow {
    const float* shown[3];
    const float* nearness;
    const float* light;
    const uint32_t* look;
    ptrdiff_t above, below; // 0: there is none
    uint32_t width;
    float most_bend;  // of nearness, in parts of it, on what counts as one plane
    float more_light; // that arrives everywhere
};

// How radiance becomes pixels of bytes.
struct ByteEncoding {
    const DisplayCurve& curve;
    float exposure;
    bool swapped; // blue first
};

// The four columns about each pixel of a row of an enlarged block, from one row of the film.
inline constexpr uint32_t kEnlargedBlock = 64;
struct alignas(64) TapRow {
    float tap[3][4][kEnlargedBlock];
};

// What a bloom takes of a pixel's light: what its brightest channel has beyond the threshold, x of
// it, bent to x / (1 + x / limit), so that no pixel gives more than the limit, times strength.
struct OverBright {
    float threshold;
    float limit;
    float strength;
};

// Six rows of a picture, of three channels.
struct BrightRows {
    const float* row[6][3];
};

// A soft disc of light on a picture.
struct Sprite {
    float x, y;                // its middle, in pixels
    float by_width, by_height; // one over its radius, either way
    float depth;               // of its middle, in metres
    float by_depth;            // one over its radius
    math::Vec3 color;          // in its middle
};

// Pixels of a tile, of rows of kStride.
struct SpriteArea {
    static constexpr uint32_t kStride = 32;

    uint32_t left, top;        // of the tile in the picture
    uint32_t begin_x, begin_y; // in the tile
    uint32_t end_x, end_y;
};

// The loops of passes, compiled for each instruction set; all of them give the same bits. Arrays
// are readable and writable up to the next multiple of 16.
struct Kernels {
    // Radiance as shown.h has it.
    void (*to_shown)(ToneMapping tones, float exposure, const float* radiance, uint32_t count,
                     float* shown);
    // As ByteEncoding has it; alpha is 255.
    void (*encode_bytes)(const ByteEncoding& encoding, const float* const radiance[3],
                         uint32_t count, uint32_t* pixels);
    // How strong an edge pixels [begin, begin + count) are: the largest step of any channel to a
    // neighbour on another surface or in other light, in steps of 1 / 255. `begin`: a multiple
    // of 16.
    void (*find_edges)(const EdgeRow& row, uint32_t begin, uint32_t count, float* strengths);
    // A row between rows[1] and rows[2]; see enlarge.h. `x`: how far each pixel is between the
    // middle taps.
    void (*enlarge_row)(const TapRow* const rows[4], const float* x, float y, uint32_t count,
                        float* const shown[3]);

    // Of a bloom's pyramid (post/bloom.h): six rows to a row of half the size, first as sums of
    // columns, of the over-bright light of a picture or of a level, then from these. There `sum` is
    // also read from two before its begin to two vectors beyond its end.
    void (*take_bright)(const OverBright& bright, const BrightRows& rows, uint32_t count,
                        float* const sums[3]);
    void (*halve_rows)(const float* const rows[6], uint32_t count, float* sum);
    void (*halve_columns)(const float* sum, uint32_t count, float* half);
    // ... and four rows to one of twice the size. The rows are those of an upper one of each two;
    // in the opposite order they give the lower one.
    void (*double_rows)(const float* const rows[4], uint32_t count, float* sum);
    void (*double_columns)(const float* sum, uint32_t count, float* twice);
    // values * weight + with * (1 - weight).
    void (*mix)(float weight, const float* with, uint32_t count, float* values);
    // Takes from pixels what they give, and adds what they get.
    void (*spread)(const OverBright& bright, const float* const glow[3], uint32_t count,
                   float* const light[3]);

    // Adds a sprite's light. `depth` and `light`: of all of the tile.
    void (*add_sprite)(const Sprite& sprite, const SpriteArea& area, const float* depth,
                       float* const light[3]);
};

// For this instruction set, or the plain one if it was not compiled. Does not ask the machine.
const Kernels& kernels(base::Isa isa);

} // namespace peregrine::render::post
