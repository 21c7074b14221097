#pragma once

#include "base/memory.h"
#include "render/plan.h"
#include "render/tile_buffers.h"

namespace peregrine::render {

// The memory of all threads for paths; none if the plan has no paths.
class PathRoom {
public:
    PathRoom(const Plan& plan, size_t threads, base::Memory* memory);

    shade::PathMemory* memory(const Plan& plan, size_t thread);
    uint64_t ray_count() const; // that was followed

private:
    base::Vector<shade::PathMemory> memory_;
    base::Vector<shade::PathRays> chunks_;
};

// What the eye is in: which solids a ray from there leaves that it did not enter.
shade::Media media_at(const scene::Snapshot& snapshot, const math::Vec3d& eye,
                      const math::Vec3& forward, const trace::Filter& filter);

// Stages from hits to radiance, as those of shading.h, with what mirrors and glass show.
void shade_tile_and_follow(const Plan& plan, TileBuffers& buffers);
void shade_blocks_and_follow(const Plan& plan, TileBuffers& buffers);

// The first `count` rays of the buffers, every ray for itself. `footprint`: in parts of theirs.
// `openness`: see Shader::take_openness.
void shade_rays_and_follow(const Plan& plan, TileBuffers& buffers, uint32_t count, float footprint,
                           const float* openness);

} // namespace peregrine::render
