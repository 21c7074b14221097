#pragma once

#include "math/vec.h"

namespace peregrine::scene {

// A horizontal layer: as dense as it gets up to `bottom`, then evenly thinner up to `top`.
struct Fog {
    float density = 0; // per metre
    double top = 0;    // heights; in snapshots relative to their origin
    double bottom = 0;
    math::Vec3 color{0}; // radiance of fog through which nothing is seen

    bool any() const { return density > 0; }
};

} // namespace peregrine::scene
