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
    uint32_t count;
};

} // namespace peregrine::shade
