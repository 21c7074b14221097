#pragma once

#include <cstdint>

namespace peregrine::shade {

// A batch of rays and what they hit: at most kBatch rays; arrays readable up to the next multiple
// of 16.
struct RayHits {
    const float* direction[3]; // any length
    const float* u;
    const float* v;
    const uint32_t* triangle;
    const uint32_t* back_face;
    const float* t; // in lengths of the direction
    uint32_t count;
    float footprint; // how wide the pixel of a ray is at t = 1; 0: textures at their finest level
};

} // namespace peregrine::shade
