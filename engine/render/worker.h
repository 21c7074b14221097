#pragma once

#include "render/frame.h"
#include "render/output.h"
#include "render/tile.h"
#include "shade/shader.h"

namespace peregrine::render {

// What all workers on a frame share; read-only.
struct FrameContext {
    const scene::Snapshot& snapshot;
    const Frame& frame;
    Pinhole pinhole;
    math::Vec3d eye;      // where its rays begin
    trace::Filter filter; // of primary rays
    shade::Shader shader;
    Output output;
};

// One thread's part in a frame: its working memory, reused from tile to tile.
class alignas(64) Worker {
public:
    void begin(const FrameContext& context);
    void render(const FrameContext& context, uint32_t tile_index);
    uint64_t shadow_ray_count() const { return scratch_.shadow_ray_count; }

private:
    void make_rays(const Pinhole& pinhole);
    void trace(const FrameContext& context);
    void show(const FrameContext& context, uint32_t first);

    alignas(64) float origin_[3][kTilePadded];
    alignas(64) float direction_[3][kTilePadded];
    alignas(64) float t_min_[kTilePadded];
    alignas(64) float t_max_[kTilePadded];
    alignas(64) float t_[kTilePadded];
    alignas(64) float u_[kTilePadded];
    alignas(64) float v_[kTilePadded];
    alignas(64) uint32_t triangle_[kTilePadded];
    alignas(64) uint32_t back_face_[kTilePadded];
    alignas(64) uint32_t steps_[kTilePadded];
    TileColors colors_;
    Tile tile_;
    shade::Scratch scratch_;
};

} // namespace peregrine::render
