#pragma once

#include "math/vec.h"

#include <cstdint>

namespace peregrine::render::bake {

// A place on a fixed triangle's front.
struct Place {
    uint32_t triangle;
    float u, v; // barycentrics
};

// What comes to it from all around.
struct Sample {
    float open = 1;      // part of the ambient light
    math::Vec3 light{0}; // mean radiance of what it sees, by the cosine
    bool buried = false; // it lies within something solid
};

} // namespace peregrine::render::bake
