#pragma once

#include "scene/lights/prepared_light.h"
#include "scene/snapshot.h"
#include "shade/light/illumination.h"
#include "shade/light/shadow_memory.h"
#include "shade/surface/space.h"
#include "trace/filter.h"
#include "trace/kernels.h"

namespace peregrine::shade {

using scene::PreparedLight;

// Who sees a light. Read-only: all threads share it.
class Shadows {
public:
    // Lights and surfaces are relative to `space.origin`.
    Shadows(const scene::Snapshot& snapshot, const SurfaceSpace& space);

    // From here on only what lets no light through at all is in its way: see Tints.
    void see_opaque_alone();

    // Whether anything that moves may be in the way from the points to the light.
    bool something_moves_before(const PreparedLight& light, const math::Box& points) const;

    // ... within a distance from the points.
    bool something_moves_near(const math::Box& points, float distance) const;

    // Traces the first `ray_count` rays that are listed in `memory`, and takes the light away where
    // something is in between; returns of how many rays. `some_are_lit`: those with State::lit in
    // memory.states are so as far as fixed triangles are concerned.
    uint32_t hide_occluded(const PreparedLight& light, uint32_t ray_count, bool some_are_lit,
                           ShadowMemory& memory, LightWeights& weights) const;

    // Fills memory.occluded for those rays, of which none is remembered.
    void trace(const PreparedLight& light, uint32_t ray_count, ShadowMemory& memory) const;

    // ... for any rays, whose origins are relative to `space.origin`.
    void trace_any(const trace::RayStream& rays, ShadowMemory& memory) const;
    // ... of which only what moves is asked.
    void trace_moving(const trace::RayStream& rays, ShadowMemory& memory) const;

    // The first `ray_count` rays of `memory`, as they are traced.
    trace::RayStream list(const PreparedLight& light, uint32_t ray_count,
                          ShadowMemory& memory) const;
    // Rays as fixed and deforming meshes see them; their origins may be in memory.moved_origin.
    trace::RayStream in_world(trace::RayStream rays, ShadowMemory& memory) const;
    trace::Positions positions_of(const trace::RayStream& rays) const;

private:
    void ask_for_mixed(const trace::RayStream& rays, ShadowMemory& memory) const;

    const scene::Snapshot* snapshot_;
    SurfaceSpace space_;
    trace::Filter filter_;
};

} // namespace peregrine::shade
