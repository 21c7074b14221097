#pragma once

#include "scene/snapshot.h"
#include "shade/kernels.h"
#include "shade/prepared_light.h"
#include "shade/triangle_shading.h"
#include "trace/kernels.h"

#include <cstdint>
#include <span>

namespace peregrine::shade {

// Working memory for one thread.
struct alignas(64) Scratch {
    Surface surface;
    Illumination light;
    LightWeights weights;
    Surface::Lanes shadow_origin[3];
    Surface::Lanes shadow_direction[3];
    Surface::Lanes moved_origin[3]; // relative to the world's origin, if the others are not
    // Where shadow rays begin and end, 0 and 1 being the surface and the light or the reverse.
    Surface::Lanes zeros;
    Surface::Lanes just_above_zero;
    Surface::Lanes just_below_one;
    Surface::Lanes ones;
    Surface::Lanes infinities;
    uint32_t shadow_index[kPadded];
    uint8_t occluded[kPadded];
    uint64_t shadow_ray_count;

    void initialize(); // of zeroed memory
};

// What a frame needs to shade the hits of its rays. Read-only: all threads share it.
struct Shader {
    const scene::Snapshot* snapshot;
    const Kernels* kernels;
    std::span<const PreparedLight> lights;
    trace::Filter shadow_filter;
    SurfaceSpace space;
    uint32_t features; // to look at; may be fewer than the snapshot has
    bool shadows;

    // `lights` must outlive the result; they and surfaces are relative to `origin`.
    static Shader prepare(const scene::Snapshot& snapshot, uint32_t features, bool shadows,
                          std::span<const PreparedLight> lights, const math::Vec3d& origin);

    // Fills scratch.surface.
    void find_surfaces(const RayHits& hits, Scratch& scratch) const;

    // Radiance of at most kBatch rays.
    void shade(const RayHits& hits, float* const radiance[3], Scratch& scratch) const;

private:
    void illuminate(const PreparedLight& light, uint32_t count, Scratch& scratch) const;
    bool hide_occluded(const PreparedLight& light, uint32_t ray_count, Scratch& scratch) const;
    trace::RayStream in_world(trace::RayStream rays, Scratch& scratch) const;
};

} // namespace peregrine::shade
