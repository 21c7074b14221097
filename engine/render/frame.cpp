#include "render/frame.h"

#include "render/plan.h"
#include "render/primary_rays.h"

#include <algorithm>
#include <atomic>
#include <chrono>

namespace peregrine::render {

void render_frame(const scene::Snapshot& snapshot, const Camera& camera, const Frame& frame,
                  base::Scheduler& scheduler, base::Memory* memory, FrameStats* stats) {
    const auto begin = std::chrono::steady_clock::now();
    base::Vector<shade::PreparedLight> moved_lights(memory);
    const Plan plan(snapshot, camera, frame, moved_lights);
    const uint32_t tile_count = Tile::tile_count(frame.width, frame.height);
    const uint32_t worker_count = std::min(scheduler.concurrency(), tile_count);
    shade::LightRoom light_room = plan.shader.light_choice().make_room(worker_count, memory);
    base::Vector<TileBuffers> workers(worker_count, memory);
    std::atomic<uint32_t> next_tile{0};
    scheduler.for_each(worker_count, [&](uint32_t i) {
        TileBuffers& buffers = workers[i];
        buffers.scratch.shadow.initialize();
        buffers.scratch.lists = light_room.lists(i);
        begin_primary_rays(plan, buffers);
        for (uint32_t tile;
             (tile = next_tile.fetch_add(1, std::memory_order_relaxed)) < tile_count;) {
            buffers.tile.place(tile, frame.width, frame.height);
            for (const Stage stage : plan.stages()) stage(plan, buffers);
        }
    });

    if (!stats) return;
    stats->threads = scheduler.concurrency();
    stats->rays_primary = uint64_t(frame.width) * frame.height;
    stats->rays_shadow = stats->light_points = 0;
    for (const TileBuffers& buffers : workers) {
        stats->rays_shadow += buffers.scratch.shadow.ray_count;
        stats->light_points += buffers.light.point_count;
    }
    stats->isa = snapshot.isa();
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - begin;
    stats->frame_ms = elapsed.count();
}

} // namespace peregrine::render
