#pragma once

#include "shade/surface/surface.h"

#include <cstdint>

namespace peregrine::shade {

// Rays through the air, as arrays that are readable up to the next multiple of 16.
struct AirRays {
    const float* origin[3]; // in a SurfaceSpace
    const float* direction[3];
    const float* t; // where they end
    uint32_t count;
};

// What bounds them: all directions are within a cone.
struct AirBounds {
    math::Vec3 axis;     // unit
    float least_cosine;  // between it and a direction
    float longest;       // metres
    math::Vec3 lower{0}; // of the origins
    math::Vec3 upper{0};
};

// The ways of rays through the light of one lamp. Places s along a ray are metres from its foot,
// where it is nearest to the lamp; angles are those at the lamp, see airlight-inl.h.
struct alignas(64) AirWays {
    using Lanes = Surface::Lanes;

    uint32_t ray[kPadded];
    Lanes foot[3];  // from the lamp
    Lanes along[3]; // unit direction
    Lanes height;   // at which the ray begins
    Lanes before;   // s + this: metres along the ray
    Lanes first;    // s where the way begins, ...
    Lanes last;     // ... and ends
    Lanes spread;   // s over the angle's tangent
    Lanes cosine;   // of the angle in the middle
    Lanes sine;
    Lanes half; // the angle from there to either end
};

// Where functions are asked that are integrated over -1 to 1, and how much each place counts.
struct AirNodes {
    static constexpr uint32_t kMost = 64;

    uint32_t count = 0;
    uint32_t in_piece = 0; // of which each has so many; 0: there are no pieces
    float at[kMost];
    float weight[kMost];
};

} // namespace peregrine::shade
