#pragma once

#include "shade/surface/ray_hits.h"
#include "shade/surface/surface.h"

#include <cstdint>

namespace peregrine::shade {

// What the rays of a tile hit: arrays readable up to the next multiple of 16.
struct TileHits {
    const float* direction[3];
    const float* t; // along the camera's forward
    const float* u;
    const float* v;
    const uint32_t* triangle;
    const uint32_t* back_face;
    uint32_t count;
    float footprint; // see RayHits

    RayHits batch(uint32_t first, uint32_t size) const {
        return {{direction[0] + first, direction[1] + first, direction[2] + first},
                u + first,
                v + first,
                triangle + first,
                back_face + first,
                t + first,
                size,
                footprint};
    }
};

// Some rays of a tile as a batch of points.
struct alignas(64) PickedHits {
    uint32_t ray[kPadded];
    Surface::Lanes direction[3];
    Surface::Lanes u;
    Surface::Lanes v;
    Surface::Lanes t;
    uint32_t triangle[kPadded];
    uint32_t back_face[kPadded];

    // Calls function(count) for batches of the rays that have a bit in `wanted`, which it loses;
    // `ray` has a batch's first `count`.
    template <class Function>
    void for_each_batch(uint8_t* wanted, uint32_t ray_count, uint8_t bit, Function&& function) {
        uint32_t count = 0;
        for (uint32_t i = 0; i < ray_count; ++i) {
            if (!(wanted[i] & bit)) continue;
            wanted[i] &= uint8_t(~bit);
            ray[count++] = i;
            if (count < kBatch) continue;
            function(count);
            count = 0;
        }
        if (count > 0) function(count);
    }

    RayHits pick(const TileHits& hits, uint32_t count) {
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t from = ray[i];
            for (int k = 0; k < 3; ++k) direction[k][i] = hits.direction[k][from];
            u[i] = hits.u[from];
            v[i] = hits.v[from];
            t[i] = hits.t[from];
            triangle[i] = hits.triangle[from];
            back_face[i] = hits.back_face[from];
        }
        return {{direction[0], direction[1], direction[2]},
                u,
                v,
                triangle,
                back_face,
                t,
                count,
                hits.footprint};
    }
};

} // namespace peregrine::shade
