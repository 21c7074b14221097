#pragma once

#include "scene/snapshot.h"
#include "shade/kernels.h"
#include "shade/light/choice.h"
#include "shade/light/shadows.h"
#include "shade/scratch.h"

#include <cstdint>
#include <span>

namespace peregrine::shade {

// What a frame needs to shade the hits of its rays. Read-only: all threads share it.
class Shader {
public:
    // `features` (scene::Feature bits): what to look at; may be fewer than the snapshot has.
    // `lights`, `origin`, `unseen`: as of LightChoice; surfaces are relative to `origin`, too.
    Shader(const scene::Snapshot& snapshot, uint32_t features, bool shadows,
           std::span<const PreparedLight> lights, const math::Vec3d& origin, float unseen);

    // Fills scratch.surface.
    void find_surfaces(const RayHits& hits, Scratch& scratch) const;

    const LightChoice& light_choice() const { return choice_; }

    // Whether what was proved of lights is true of this frame's surfaces
    // (trace/visibility/shaft.h).
    bool proofs_hold() const {
        return !space_.is_elsewhere && space_.fixed_reach <= 2 * space_.fixed_size;
    }

    // Radiance of at most kBatch rays.
    void shade(const RayHits& hits, float* const radiance[3], Scratch& scratch) const;

private:
    void illuminate(const PreparedLight& light, const RayHits& hits, Scratch& scratch) const;

    const scene::Snapshot* snapshot_;
    const Kernels* kernels_;
    std::span<const PreparedLight> lights_;
    LightChoice choice_;
    SurfaceSpace space_;
    Shadows shadows_;
    uint32_t features_;
    Program program_;
    bool traces_shadows_;
};

} // namespace peregrine::shade
