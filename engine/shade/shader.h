#pragma once

#include "scene/snapshot.h"
#include "shade/kernels.h"
#include "shade/light/lighting.h"
#include "shade/occlusion/openness.h"
#include "shade/program/programs.h"
#include "shade/scratch.h"

#include <cstdint>
#include <optional>
#include <span>

namespace peregrine::shade {

// What a frame needs to shade the hits of its rays. Read-only: all threads share it.
class Shader {
public:
    // `features` (scene::Feature bits): what to look at; may be fewer than the snapshot has.
    // `lights`, `origin`, `unseen`: as of LightChoice; surfaces are relative to `origin`, too.
    Shader(const scene::Snapshot& snapshot, uint32_t features, bool shadows,
           std::span<const PreparedLight> lights, const math::Vec3d& origin, float unseen);

    // From here on, ambient light is that which arrives: see Openness. Threads then need
    // scratch.openness.
    void occlude_ambient_light(float range, uint32_t samples) {
        openness_.emplace(*snapshot_, space_, range, samples);
    }
    // From here on, light is tinted by what it passes: see Tints. Threads then need scratch.tints.
    void tint_light() { lighting_.tint(); }
    bool tints_light() const { return lighting_.tints(); }
    bool finds_openness() const { return openness_.has_value(); }
    // From here on, openness is what these say, where they know that.
    void recall_openness_from(const scene::PointGrids& grids) { openness_grids_ = &grids; }
    bool recalls_openness() const { return openness_grids_ != nullptr; }
    // From here on, surfaces get the light that others send, where these know that.
    void add_bounced_light_from(const scene::PointGrids& grids) { bounced_grids_ = &grids; }

    // Fills scratch.surface.
    void find_surfaces(const RayHits& hits, SurfacePart part, Scratch& scratch) const;

    // Fills scratch.light for scratch.surface; see Lighting::gather.
    void gather_light(const RayHits& hits, Scratch& scratch, BatchMarks* marks) const;

    // Of hits. Fills scratch.surface with SurfacePart::smooth.
    void find_openness(const RayHits& hits, Scratch& scratch, float* openness) const;
    // What is recalled of it; where that is nothing, it is negative. May fill scratch.surface.
    void recall_openness(const RayHits& hits, Scratch& scratch, float* openness) const;

    // Fills what scratch.light has of surroundings. `openness`: if it is known, else null; then
    // scratch.surface is used.
    void take_surroundings(const RayHits& hits, const float* openness, Scratch& scratch) const;

    // From scratch.surface and scratch.light. `rays`: as of Programs::run.
    void find_radiance(const RayHits& hits, float* const radiance[3], Scratch& scratch,
                       const AskedRays* rays = nullptr) const;
    // What it needs of surfaces whose light is known.
    SurfacePart part_beside_light() const {
        return programs_.any() ? SurfacePart::all : SurfacePart::colors;
    }
    bool has_programs() const { return programs_.any(); }

    // Over what find_radiance() says of rays that hit nothing, if there is a sky.
    bool has_sky() const { return features_ & scene::kSky; }
    void paint_sky(const RayHits& hits, float* const radiance[3]) const {
        kernels_->paint_sky(snapshot_->environment.sky, hits, radiance);
    }

    // All of it but the sky: radiance of at most kBatch rays. `openness`: of these rays, if it is
    // known.
    void shade(const RayHits& hits, float* const radiance[3], Scratch& scratch,
               const float* openness = nullptr) const;

    std::span<const PreparedLight> lights() const { return lighting_.lights(); }
    const LightChoice& light_choice() const { return lighting_.choice(); }
    const Kernels& kernels() const { return *kernels_; }
    const SurfaceSpace& space() const { return space_; }
    uint32_t features() const { return features_; }
    Program program() const { return program_; }

private:
    Surroundings surroundings() const;
    void apply_occlusion_textures(uint32_t count, Scratch& scratch) const;

    const scene::Snapshot* snapshot_;
    const Kernels* kernels_;
    SurfaceSpace space_;
    uint32_t features_;
    Program program_;
    Lighting lighting_;
    std::optional<Openness> openness_;
    const scene::PointGrids* openness_grids_ = nullptr;
    const scene::PointGrids* bounced_grids_ = nullptr;
    Programs programs_;
};

} // namespace peregrine::shade
