#pragma once

#include "base/isa.h"
#include "scene/light_map.h"
#include "scene/lights/prepared_light.h"
#include "scene/snapshot.h"
#include "shade/air/air_ways.h"
#include "shade/light/illumination.h"
#include "shade/material/program.h"
#include "shade/path/path_rays.h"
#include "shade/surface/ray_hits.h"
#include "shade/surface/space.h"
#include "shade/surface/surface.h"

#include <array>
#include <cstdint>

namespace peregrine::shade {

using scene::PreparedLight;

// What is known of the way from a point to a light. The first ones are trace::visibility::State.
enum class PointState : uint32_t {
    hidden = 0, // it is blocked
    lit = 1,    // nothing fixed is in the way
    mixed = 2,  // nothing: it is to be traced
    seen = 3,   // nothing at all is in the way
};

struct Recalled {
    const uint32_t* states = nullptr; // PointState of each point; null: all are mixed
    bool traces_lit = false; // something moves in between: rays are listed for lit points, too
};

// Where a light kernel puts the rays toward its light, packed.
struct ShadowRays {
    float* origin[3];
    float* direction[3];
    uint32_t* index; // of the ray in its batch
};

// Weighs a light at each point and lists the rays toward it from those that it may reach and of
// which nothing is remembered; returns their number.
using WeighLight = uint32_t (*)(const Surface& surface, uint32_t count, const PreparedLight& light,
                                const Recalled& recalled, LightWeights& weights,
                                const ShadowRays& rays);

// By fall-off and program.
using WeighLights = std::array<ByProgram<WeighLight>, scene::kFalloffCount>;

// What lies at the hits. `features`: what to look at (scene::Feature bits).
using FindSurfaces = void (*)(const scene::Snapshot& snapshot, uint32_t features,
                              const SurfaceSpace& space, const RayHits& hits, Surface& out);

// Adds the weighed light.
using AddLight = void (*)(const LightWeights& weights, uint32_t count, const math::Vec3& color,
                          Illumination& sum);

// Radiance toward the viewer.
using FindRadiance = void (*)(const Surface& surface, const Illumination& light,
                              const RayHits& hits, const scene::Environment& environment,
                              float* const radiance[3]);

// Takes from the surfaces of hits what the rays that go on will bring (path/split-inl.h). `media`:
// of the rays that arrive.
using SplitPaths = void (*)(const scene::Snapshot& snapshot, uint32_t features,
                            const SurfaceSpace& space, const RayHits& hits, const Media* media,
                            Surface& surface, SplitRays& out);

// A layer of fog (scene/fog.h), relative to where surfaces are.
struct FogLayer {
    float density;
    float top, bottom;
    float thinning; // by a metre upward, in parts of the density; 0 if it ends at once
    math::Vec3 color;
};

// By fall-off; see air/airlight-inl.h.
using AddUpAirlight = std::array<void (*)(const PreparedLight& light, const FogLayer& layer,
                                          const AirNodes& nodes, const Surface::Lanes* seen,
                                          const AirWays& ways, uint32_t count, float* sums),
                                 scene::kFalloffCount>;

// The loops over a batch, compiled for each instruction set; all of them give the same bits.
struct Kernels {
    std::array<FindSurfaces, kSurfaceParts> find_surfaces; // by SurfacePart

    // What is remembered of the light at each point, as visibility::State; returns which of them
    // occur, as bits.
    uint32_t (*recall)(const trace::visibility::PointVisibility& visibility, const Surface& surface,
                       uint32_t first_moving, const RayHits& hits, uint32_t* states);

    // See baked/recall_light-inl.h.
    void (*recall_openness)(const scene::PointGrids& grids, const RayHits& hits, float* openness);
    void (*recall_bounced)(const scene::PointGrids& grids, const RayHits& hits,
                           float* const bounced[3]);

    std::array<WeighLights, 3> weigh_light; // by type of light

    ByProgram<AddLight> add_light;
    // By Surroundings, and whether surfaces are emissive.
    std::array<std::array<ByProgram<FindRadiance>, 2>, kSurroundings> find_radiance;

    // Of blocks of a tile (blocks/blocks-inl.h).
    bool (*block_is_smooth)(const float* t, uint32_t side, float pixel, float part);
    void (*interpolate_block)(float* values, uint32_t side);

    // What the rays see that hit nothing.
    void (*paint_sky)(const scene::Sky& sky, const RayHits& hits, float* const radiance[3]);

    // See air/fog.h.
    void (*find_clear)(const FogLayer& layer, const float* heights, const float* const direction[3],
                       const float* t, uint32_t count, float* clear);
    void (*veil)(const math::Vec3& color, const float* clear, uint32_t count,
                 float* const radiance[3]);

    // See air/airlight-inl.h.
    AirBounds (*bound_rays)(const AirRays& rays, const math::Vec3& axis);
    uint32_t (*list_ways)(const PreparedLight& light, const FogLayer& layer, const AirRays& rays,
                          uint32_t part, AirWays& out);
    void (*place_points)(const AirWays& ways, const uint32_t* way, const float* at, uint32_t count,
                         float* const to[3]);
    std::array<AddUpAirlight, 2> add_up_airlight; // of points, of spots

    std::array<SplitPaths, 2> split_paths; // whether programs of the host are there
    // Takes from weights what is absorbed on the way to t.
    void (*absorb)(const float* const direction[3], const float* t, uint32_t count,
                   const Surface::Lanes* absorption, Surface::Lanes* weight);
};

// For this instruction set, or the plain one if it was not compiled. Does not ask the machine.
const Kernels& kernels(base::Isa isa);

} // namespace peregrine::shade
