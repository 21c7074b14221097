#pragma once

#include "accel/kdtree/tree.h"
#include "base/isa.h"
#include "geometry/triangle.h"
#include "math/box.h"
#include "math/ray.h"
#include "trace/filter.h"

#include <cstdint>

namespace peregrine::trace {

// What rays are traced against.
struct Target {
    const geometry::Triangle* triangles;
    const accel::kdtree::Node* nodes;
    const uint32_t* references;
    math::Box bounds;
};

// The closest hit of one ray.
struct Hit {
    float t;
    float u;
    float v;
    uint32_t triangle; // index in Target::triangles, kNoTriangle for a miss (then t = +infinity)
    bool back_face;
    uint32_t steps; // nodes visited
};

// Rays as separate arrays, `count` long. Arrays are 64-byte aligned and padded to a multiple of 16.
struct RayStream {
    const float* origin[3];
    const float* direction[3];
    const float* t_min;
    const float* t_max;
    uint32_t count;
};

struct HitStream {
    float* t;
    float* u;
    float* v;
    uint32_t* triangle;  // kNoTriangle for a miss
    uint32_t* back_face; // 1 or 0
    uint32_t* steps;     // nodes visited by each ray's packet; null: not counted
};

// One table for each instruction set; all of them give the same bits. `stream` kernels are for rays
// of which neighbours are alike: they trace as many at a time as the machine's vectors are wide.
struct Kernels {
    Hit (*closest)(const Target& target, const math::Ray& ray, const Filter& filter);
    bool (*occluded)(const Target& target, const math::Ray& ray, const Filter& filter);
    void (*closest_stream)(const Target& target, const RayStream& rays, const Filter& filter,
                           const HitStream& hits);
    void (*occluded_stream)(const Target& target, const RayStream& rays, const Filter& filter,
                            uint8_t* occluded);
    base::Isa isa; // never `best`
};

// The table for an instruction set; null if this machine lacks it. `best` never fails.
const Kernels* select_kernels(base::Isa isa);

} // namespace peregrine::trace
