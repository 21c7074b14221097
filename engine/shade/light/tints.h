#pragma once

#include "scene/snapshot.h"
#include "shade/light/shadows.h"
#include "shade/material/program.h"
#include "shade/scratch.h"
#include "trace/filter.h"

namespace peregrine::shade {

// Light through glass and blended surfaces: shadow rays go on straight, and bring what they are
// left with. Shadows see opaque surfaces alone (Shadows::see_opaque_alone); of the rays that these
// leave those that meet anything else are followed from surface to surface. Read-only: all threads
// share it.
class Tints {
public:
    Tints(const scene::Snapshot& snapshot, const SurfaceSpace& space);

    // Takes what is tinted of a lamp's light out of scratch.weights, ...
    void take(const Shadows& shadows, const PreparedLight& light, uint32_t ray_count,
              Scratch& scratch) const;
    // ... and adds it to scratch.light.
    void give_back(const PreparedLight& light, Program program, Scratch& scratch) const;

private:
    bool may_meet(const PreparedLight& light, const math::Box& points, TintMemory& memory) const;
    uint32_t list(const trace::RayStream& rays, const Scratch& scratch, TintMemory& memory) const;

    const scene::Snapshot* snapshot_;
    math::Vec3d origin_; // that surfaces and lights are relative to
    trace::Filter filter_;
};

} // namespace peregrine::shade
