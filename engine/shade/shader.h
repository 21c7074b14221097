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
    // Of what is remembered of a light, and of rays that only fixed triangles are asked about.
    alignas(64) uint32_t states[kPadded];
    Surface::Lanes fixed_origin[3];
    Surface::Lanes fixed_direction[3];
    uint32_t fixed_index[kPadded];
    uint8_t fixed_occluded[kPadded];
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

    // Whether what was proved of lights is true of this frame's surfaces
    // (trace/visibility/shaft.h).
    bool proofs_hold() const {
        return !space.is_elsewhere && space.fixed_reach <= 2 * space.fixed_size;
    }

    // Radiance of at most kBatch rays.
    void shade(const RayHits& hits, float* const radiance[3], Scratch& scratch) const;

private:
    void illuminate(const PreparedLight& light, const RayHits& hits, Scratch& scratch) const;
    bool something_moves_before(const PreparedLight& light, const math::Box& points) const;
    uint32_t hide_occluded(const PreparedLight& light, uint32_t ray_count, bool some_are_lit,
                           Scratch& scratch) const;
    void ask_for_mixed(const trace::RayStream& rays, Scratch& scratch) const;
    trace::RayStream in_world(trace::RayStream rays, Scratch& scratch) const;
};

} // namespace peregrine::shade
