#pragma once

#include "scene/fog.h"
#include "shade/kernels.h"

namespace peregrine::shade {

// Fog between the eye and what its rays hit, and along paths. Read-only: all threads share it.
class Fog {
public:
    // `eye`: relative to the world's origin.
    Fog(const scene::Fog& fog, const Kernels& kernels, const SurfaceSpace& space,
        const math::Vec3d& eye);

    bool any() const { return layer_.density > 0; }
    const FogLayer& layer() const { return layer_; }

    // How much of the light comes through, along the first t of rays that begin at these heights.
    void find_clear(const float* heights, const float* const direction[3], const float* t,
                    uint32_t count, float* clear) const {
        kernels_->find_clear(layer_, heights, direction, t, count, clear);
    }
    // ... at the eye; at most kBatch.
    void find_clear(const float* const direction[3], const float* t, uint32_t count,
                    float* clear) const {
        find_clear(eye_heights_, direction, t, count, clear);
    }
    void find_clear(const RayHits& hits, float* clear) const {
        find_clear(hits.direction, hits.t, hits.count, clear);
    }
    // Puts the fog before radiance.
    void veil(const float* clear, uint32_t count, float* const radiance[3]) const {
        kernels_->veil(layer_.color, clear, count, radiance);
    }

private:
    const Kernels* kernels_;
    FogLayer layer_;
    Surface::Lanes eye_heights_;
};

} // namespace peregrine::shade
